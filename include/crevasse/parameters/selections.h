// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_selections_h
#define crevasse_parameters_selections_h

#include <crevasse/base/selection.h>
#include <crevasse/creep/creep_law.h>

namespace Crevasse
{
  // Enums that a scene selects by name: values, documentation, names and
  // traits. Factories of classes are where the classes are.

  enum class Shape
  {
    edge_crack,
    centre_crack,
    rectangle,
    box,
    mesh_file
  };

  template <>
  struct Selection<Shape>
  {
    struct Row
    {
      Shape       value;
      const char *name;
      bool        has_crack;
    };
    static constexpr Row rows[] = {{Shape::edge_crack, "edge crack", true},
                                   {Shape::centre_crack, "centre crack", true},
                                   {Shape::rectangle, "rectangle", false},
                                   {Shape::box, "box", false},
                                   {Shape::mesh_file, "mesh file", false}};
    static constexpr const char *meaning =
      "Shape of the body. Built-in shapes are the part of a plate above the "
      "crack plane y = 0. \"edge crack\": a half with a crack from the right "
      "side, whose tip is at x = Width - Crack length. \"centre crack\": a "
      "quarter with a crack from x = 0 to x = Crack length. In three "
      "dimensions the crack goes through the plate, with a straight front "
      "along z. \"rectangle\" (two dimensions) and \"box\" (three) have no "
      "crack. \"mesh file\" reads a mesh.";
  };

  enum class PlaneState
  {
    plane_stress,
    plane_strain,
    axisymmetric
  };

  template <>
  struct Selection<PlaneState>
  {
    static constexpr NamedValue<PlaneState> rows[] = {
      {PlaneState::plane_stress, "plane stress"},
      {PlaneState::plane_strain, "plane strain"},
      {PlaneState::axisymmetric, "axisymmetric"}};
    static constexpr const char *meaning =
      "Assumption on the third direction in two dimensions; three-dimensional "
      "bodies ignore it. \"axisymmetric\": a body of revolution, where x is "
      "the radius, y the axis, and the third direction the circumference.";
  };

  enum class ViscosityType
  {
    relaxation_time,
    isotropic,
    matrix,
    chain,
    power_law,
    hyperbolic_sine,
    strain_hardening,
    none
  };

  template <>
  struct Selection<ViscosityType>
  {
    struct Row
    {
      ViscosityType value;
      const char   *name;
      /** Creep law, or null if creep is linear or absent. */
      const CreepLaw &(*creep_law)();
    };
    static constexpr Row rows[] = {
      {ViscosityType::relaxation_time, "relaxation time", nullptr},
      {ViscosityType::isotropic, "isotropic", nullptr},
      {ViscosityType::matrix, "matrix", nullptr},
      {ViscosityType::chain, "chain", nullptr},
      {ViscosityType::power_law, "power law", power_law},
      {ViscosityType::hyperbolic_sine, "hyperbolic sine", hyperbolic_sine},
      {ViscosityType::strain_hardening, "strain hardening", strain_hardening},
      {ViscosityType::none, "none", nullptr}};
    static constexpr const char *meaning =
      "How the body creeps: \"relaxation time\" makes the viscosity the "
      "stiffness (without its time factor) times Relaxation time; "
      "\"isotropic\" builds it from Viscous modulus and Viscous Poisson ratio; "
      "\"matrix\" is Viscosity matrix; \"chain\" puts several such bodies in "
      "parallel; \"none\" is an elastic body. Nonlinear laws preserve volume; "
      "their rate under tension is Creep coefficient times: \"power law\" "
      "stress ^ Creep exponent; \"hyperbolic sine\" sinh(stress / Reference "
      "stress) ^ Creep exponent; \"strain hardening\" stress ^ Creep exponent "
      "/ (creep strain ^ Hardening exponent).";
  };

  /** Volumetric part of the strain: of the displacement gradient at the point,
   * or its mean over the cell (B-bar; Hughes 1980), which keeps linear
   * elements from locking in nearly incompressible bodies. */
  enum class VolumetricStrain
  {
    full,
    mean
  };

  template <>
  struct Selection<VolumetricStrain>
  {
    static constexpr NamedValue<VolumetricStrain> rows[] =
      {{VolumetricStrain::full, "full"}, {VolumetricStrain::mean, "mean"}};
    static constexpr const char *meaning =
      "Volumetric part of the strain. \"full\": pointwise; \"mean\": mean over "
      "the cell (B-bar), which linear elements need for nearly incompressible "
      "bodies, with a Poisson ratio near 0.5 in plane strain or three "
      "dimensions.";
  };

  enum class SingularFunctionNumber
  {
    none,
    one,
    two,
    three,
    automatic
  };

  template <>
  struct Selection<SingularFunctionNumber>
  {
    static constexpr NamedValue<SingularFunctionNumber> rows[] = {
      {SingularFunctionNumber::none, "0"},
      {SingularFunctionNumber::one, "1"},
      {SingularFunctionNumber::two, "2"},
      {SingularFunctionNumber::three, "3"},
      {SingularFunctionNumber::automatic, "automatic"}};
    static constexpr const char *meaning =
      "Number of crack-tip functions that enrich the finite elements. 1: the "
      "field of a unit K_I; 2: also the second field with the square root of "
      "r, for a viscous Poisson ratio that differs from the elastic one; 3: "
      "also the field with r^(3/2). A tip between two lips has as many "
      "functions of mode II in addition. \"automatic\": 2 at the tip of a "
      "built-in crack in the plane where the scene allows them, otherwise 0.";
  };

  enum class RefinementStrategy
  {
    none,
    tip,
    adaptive
  };

  template <>
  struct Selection<RefinementStrategy>
  {
    static constexpr NamedValue<RefinementStrategy> rows[] = {
      {RefinementStrategy::none, "none"},
      {RefinementStrategy::tip, "tip"},
      {RefinementStrategy::adaptive, "adaptive"}};
    static constexpr const char *meaning =
      "Strategy of mesh refinement after [Geometry] Refinements: \"tip\" "
      "repeatedly divides the cells at the crack tip, \"adaptive\" divides the "
      "cells with the largest estimated error. With \"none\", cells at the tip "
      "of a built-in crack are halved six times where K is computed in the "
      "plane and automatic Singular functions are 0.";
  };

  enum class Marking
  {
    bulk,
    fixed_fraction
  };

  template <>
  struct Selection<Marking>
  {
    static constexpr NamedValue<Marking> rows[] = {{Marking::bulk, "bulk"},
                                                   {Marking::fixed_fraction,
                                                    "fixed fraction"}};
    static constexpr const char         *meaning =
      "Meaning of Refine fraction and Coarsen fraction: fractions of the "
      "estimated error (\"bulk\", Doerfler's marking) or of the number of "
      "cells (\"fixed fraction\").";
  };

  enum class StressIntensityChoice
  {
    off,
    on,
    automatic
  };

  template <>
  struct Selection<StressIntensityChoice>
  {
    static constexpr NamedValue<StressIntensityChoice> rows[] = {
      {StressIntensityChoice::off, "false"},
      {StressIntensityChoice::on, "true"},
      {StressIntensityChoice::automatic, "automatic"}};
    static constexpr const char *meaning =
      "Whether the run computes stress intensity factors: K_I of each step in "
      "crack_tip.csv; K_I and K_II of each tip of cracks with two lips in "
      "crack_tip_1.csv, crack_tip_2.csv, ...; in three dimensions K_I, with "
      "two lips also K_II and K_III, along the front in the last period in "
      "crack_front.csv. \"automatic\": in the plane, where K_I can be "
      "computed.";
  };

  enum class StressIntensityMethod
  {
    automatic,
    interaction_integral,
    williams_fit
  };

  template <>
  struct Selection<StressIntensityMethod>
  {
    static constexpr NamedValue<StressIntensityMethod> rows[] = {
      {StressIntensityMethod::automatic, "automatic"},
      {StressIntensityMethod::interaction_integral, "interaction integral"},
      {StressIntensityMethod::williams_fit, "williams fit"}};
    static constexpr const char *meaning =
      "Method for K_I: an interaction integral over a square around the tip, "
      "or a fit of Williams' series to the stress around the tip. "
      "\"automatic\": the integral; the fit is a check.";
  };

  /** Part of a growth law that depends on the range of K. */
  enum class FatigueLaw
  {
    none,
    paris,
    walker,
    table
  };

  enum class GrowthLawType
  {
    none,
    paris,
    walker,
    table,
    creep,
    sum,
    walker_and_creep,
    table_and_creep
  };

  template <>
  struct Selection<GrowthLawType>
  {
    struct Row
    {
      GrowthLawType value;
      const char   *name;
      FatigueLaw    fatigue;
      bool          has_creep_part;
    };
    static constexpr Row rows[] = {
      {GrowthLawType::none, "none", FatigueLaw::none, false},
      {GrowthLawType::paris, "paris", FatigueLaw::paris, false},
      {GrowthLawType::walker, "walker", FatigueLaw::walker, false},
      {GrowthLawType::table, "table", FatigueLaw::table, false},
      {GrowthLawType::creep, "creep", FatigueLaw::none, true},
      {GrowthLawType::sum, "sum", FatigueLaw::paris, true},
      {GrowthLawType::walker_and_creep,
       "walker and creep",
       FatigueLaw::walker,
       true},
      {GrowthLawType::table_and_creep,
       "table and creep",
       FatigueLaw::table,
       true}};
    static constexpr const char *meaning =
      "Law of the crack's growth. \"paris\": da/dN = C (dK - dK_th)^m; "
      "\"walker\": da/dN = C dK^m f_R f_th / f_c, with factors for R = "
      "K_min/K_max, the threshold and the toughness; \"table\": the Growth "
      "table; \"creep\": da/dt = D P^phi, where P is the Creep growth "
      "parameter; \"sum\": paris and creep.";
  };

  enum class GrowthRange
  {
    whole,
    effective
  };

  template <>
  struct Selection<GrowthRange>
  {
    static constexpr NamedValue<GrowthRange> rows[] = {
      {GrowthRange::whole, "Delta K"},
      {GrowthRange::effective, "Delta K eff"}};
    static constexpr const char *meaning =
      "Range dK of the laws of fatigue: K_max - K_min, where K < 0 counts as "
      "0, or K_max - K_op, in which the lip is open.";
  };

  enum class CreepParameter
  {
    C_star,
    C_of_t,
    stress_intensity
  };

  template <>
  struct Selection<CreepParameter>
  {
    static constexpr NamedValue<CreepParameter> rows[] = {
      {CreepParameter::C_star, "C star"},
      {CreepParameter::C_of_t, "C(t)"},
      {CreepParameter::stress_intensity, "stress intensity"}};
    static constexpr const char *meaning =
      "Quantity P that drives growth by creep: the integral C* of the secular "
      "flow, or C(t) (see Creep integral) or K_I at each instant of the "
      "period.";
  };

  enum class FieldFormat
  {
    vtu,
    none
  };

  template <>
  struct Selection<FieldFormat>
  {
    static constexpr NamedValue<FieldFormat> rows[] =
      {{FieldFormat::vtu, "vtu"}, {FieldFormat::none, "none"}};
    static constexpr const char *meaning = "File format of the fields.";
  };

  /** Lip of the elastic body with which the stress of a run is compared. */
  enum class ComparedLip
  {
    none,
    open,
    closed
  };

  template <>
  struct Selection<ComparedLip>
  {
    static constexpr NamedValue<ComparedLip> rows[] = {
      {ComparedLip::none, "none"},
      {ComparedLip::open, "open"},
      {ComparedLip::closed, "closed"}};
    static constexpr const char *meaning =
      "Whether the stress of the last period is compared with the closed form "
      "from an elastic body whose crack is always open, or always closed. This "
      "needs loads F(t) p(x), no gap, and no viscosity or one proportional to "
      "the stiffness. \"closed\" needs an F of one sign; so does \"open\" "
      "without viscosity.";
  };
} // namespace Crevasse

#endif
