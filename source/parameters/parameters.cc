// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  using namespace dealii;

  // The pattern describes the allowed values, or the documentation after
  // "Allowed:" where the pattern does not suffice.
  namespace
  {
    const NumberPattern size(Ranges::positive);
  }



  std::vector<unsigned int>
  parse_subdivisions(const std::string &text)
  {
    if (text == "automatic")
      return {};
    const Patterns::List pattern(Patterns::Integer(1), 1);
    if (!pattern.match(text))
      throw SceneError(
        "must be automatic, or as many integers of at least 1 as "
        "dimensions, separated by commas");
    return Patterns::Tools::Convert<std::vector<unsigned int>>::to_value(
      text, pattern);
  }



  std::map<unsigned int, double>
  parse_crack_growth(const std::string &text)
  {
    const Patterns::Map pattern(Patterns::Integer(1),
                                Patterns::Double(0.),
                                0,
                                Patterns::Map::max_int_value,
                                ";",
                                ":");
    if (!pattern.match(text))
      throw SceneError(
        "must have pairs of a number of periods and a length, "
        "such as 10: 0.55; 20: 0.6");
    return Patterns::Tools::Convert<std::map<unsigned int, double>>::to_value(
      text, pattern);
  }



  void
  GeometryParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Shape", shape, prm);
    prm.add_parameter("Width",
                      width,
                      "Extent in x of a built-in shape, in units of length.",
                      size);
    prm.add_parameter("Height",
                      height,
                      "Extent in y of a built-in shape above the crack plane, "
                      "in units of length.",
                      size);
    prm.add_parameter("Thickness",
                      thickness,
                      "Extent in z of a built-in shape in three dimensions, "
                      "from z = 0 on, in units of length.",
                      size);
    prm.add_parameter("Crack length",
                      crack_length,
                      "Length of the modelled part of the crack, in units of "
                      "length. Allowed: a number greater than 0 and less than "
                      "Width",
                      size);
    crack_growth.add_parameter(
      "Crack growth",
      "Lengths to which the crack grows after numbers of periods, in units of "
      "length: its nodes are released, and the viscous strain stays in place. "
      "The cells must be the same for all lengths. Allowed: nothing, or pairs "
      "such as 10: 0.55; 20: 0.6",
      prm);
    prm.add_parameter(
      "Mesh file",
      mesh_file,
      "Mesh of triangles and quadrilaterals (in three dimensions: of "
      "tetrahedra, wedges and hexahedra) with boundary ids, for Shape = mesh "
      "file. The program looks for the file "
      "next to the scene file, then in the working directory. Second-order "
      "elements of a Gmsh file (Mesh.ElementOrder = 2) have circular arcs as "
      "edges: with Degree = 2 cells are curved, in the plane also after "
      "refinement. A file of Abaqus or CalculiX (.inp), UNV, MED, Exodus (.e, "
      ".exo) or VTK (.vtk, .vtu) is converted before the run, to a Gmsh file "
      "in results/meshes; a geometry (.geo, .brep) is meshed by Gmsh. Allowed: "
      "a Gmsh file (.msh), one of these, or "
      "another format that deal.II reads");
    subdivisions.add_parameter(
      "Subdivisions",
      "Numbers of cells of a built-in shape along x and y (and z), before "
      "refinement. If equal cells put no vertex at the crack tip, crack and "
      "ligament are divided separately. \"automatic\": squares with sides of "
      "1/7 (in three dimensions 1/4) of the shortest of crack, ligament and "
      "height, but at most 64 (24) cells in a direction. Allowed: automatic, "
      "or as many integers of at least 1 as dimensions, separated by commas",
      prm);
    prm.add_parameter(
      "Refinements",
      refinements,
      "Number of times that all cells are halved in each direction.",
      Patterns::Integer(0, 12));
  }



  void
  BoundaryParameters::add_parameters(ParameterHandler &prm)
  {
    const std::string others =
      " for a built-in shape, without ids that have another role, and none for "
      "a mesh file";
    const std::string allowed =
      ". Allowed: automatic, none, or boundary ids separated by commas; for a "
      "Gmsh file also names of physical groups";

    clamped.add_parameter(
      "Clamped",
      "Boundary ids where the displacement is zero. Sides of built-in shapes: "
      "0 left; 1 right; 2 bottom, except the crack lip; 3 top; 4 crack lip; 5 "
      "z = 0; 6 z = Thickness. \"automatic\" is none" +
        allowed,
      prm);
    displaced.add_parameter(
      "Displaced",
      "Boundary ids where [Loads] Displacement is imposed. \"automatic\" is "
      "none" +
        allowed,
      prm);
    symmetry.add_parameter("Symmetry",
                           "Boundary ids of symmetry planes: the normal "
                           "displacement and the tangential traction are zero. "
                           "\"automatic\" is 2 (and 0 with a centre crack)" +
                             others + allowed,
                           prm);
    loaded.add_parameter("Loaded",
                         "Boundary ids that carry the traction or pressure of "
                         "the section Loads; lips of cracks may be among them. "
                         "\"automatic\" is 3" +
                           others + allowed,
                         prm);
    contact.add_parameter(
      "Contact",
      "Boundary ids of lips in contact with a rigid plane, such as the crack "
      "plane of a symmetric body: they may open, but not penetrate it. "
      "\"automatic\" is 4 (none without a crack)" +
        others + allowed,
      prm);
    crack.add_parameter(
      "Crack",
      "Boundary ids of cracks with two lips, which may open, but not penetrate "
      "each other. In a Gmsh file a crack is a physical group of faces within "
      "the body, along which the program cuts the mesh. Other meshes have both "
      "lips: each face of one lip lies on a face of the other. \"automatic\" "
      "is none" +
        allowed,
      prm);
    open_crack.add_parameter(
      "Open crack",
      "Boundary ids of lips that never touch: of cracks as for Crack, or of "
      "one "
      "lip as for Contact. They get K, T and singular functions, and may "
      "penetrate. \"automatic\" is 4 of a built-in shape with a crack whose "
      "Contact does not have it" +
        allowed,
      prm);
    fixed_points.add_parameter(
      "Fixed points",
      "Mesh vertices with zero displacement, against rigid-body motion: "
      "coordinates in units of length, and after a colon the numbers of the "
      "fixed components, from 1; without a colon all components are fixed. "
      "\"automatic\" prevents rigid-body motion of a built-in shape along the "
      "crack plane where clamped sides and symmetry planes do not, and is none "
      "for a mesh file. Allowed: automatic, none, or a list such as 0, 0; 1, "
      "0: 2",
      prm);
    gap.add_parameter(
      "Gap",
      "Lower bound of the normal displacement of the lip (of two lips relative "
      "to each other), in units of length. 0: the unloaded crack is closed; "
      "negative: it is open by this length. Allowed: a formula of x, y, z with "
      "values of at most 0",
      prm);
    friction.add_parameter(
      "Friction coefficient",
      "Coefficient of Coulomb's friction between lips that touch, or between a "
      "lip and a rigid plane: they slide only where the shear stress reaches "
      "this coefficient times the pressure. Allowed: 0 (no friction), a "
      "greater number, or a formula of x, y, z, t, theta with values of at "
      "least 0; or such values by boundary, as in 7: 0.3 | 8: 0.1*x (0 on "
      "other lips)",
      prm);
  }



  void
  MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    // Descriptions of allowed values that several coefficients share.
    const std::string formula =
      " or a formula of x, y, z, t, theta, material with such values";
    const std::string positive = " Allowed: a number greater than 0" + formula;
    const std::string matrix =
      "a symmetric matrix of numbers or formulas: rows separated by "
      "semicolons, entries by commas. Order of the components: 11, 22, 12 "
      "(plane stress); 11, 22, 33, 12 (two dimensions); 11, 22, 33, 12, 13, 23 "
      "(three dimensions). Shear strains are engineering strains";
    const std::string factor =
      " Allowed: a formula of t with values greater than 0";

    add_selection("Plane state", plane_state, prm);
    young_modulus.add_parameter(
      "Young modulus",
      "Young's modulus of the elastic strain, in units of stress." + positive,
      prm);
    poisson_ratio.add_parameter(
      "Poisson ratio",
      "Poisson's ratio of the elastic strain. Allowed: a number of at least "
      "-0.999, less than 0.5" +
        formula,
      prm);
    stiffness_matrix.add_parameter(
      "Stiffness matrix",
      "Elastic stiffness in units of stress, instead of Young modulus and "
      "Poisson ratio. Allowed: empty, or " +
        matrix,
      prm);
    stiffness_time_factor.add_parameter(
      "Stiffness time factor",
      "Factor of the stiffness, uniform in space: ageing that needs no further "
      "factorisation. It does not change the viscosity." +
        factor,
      prm);
    add_selection("Viscosity", viscosity, prm);
    relaxation_time.add_parameter(
      "Relaxation time",
      "Ratio of viscosity to stiffness, in units of time." + positive,
      prm);
    viscous_modulus.add_parameter(
      "Viscous modulus",
      "Ratio of stress to viscous strain rate under uniaxial tension, in units "
      "of stress times time." +
        positive,
      prm);
    viscous_poisson_ratio.add_parameter(
      "Viscous Poisson ratio",
      "Ratio of lateral to axial viscous strain under uniaxial tension; with "
      "0.5 viscous flow preserves volume. Allowed: a number of at least "
      "-0.999, at most 0.5" +
        formula,
      prm);
    std::set<std::string> declared;
    for (const auto &row : Selection<ViscosityType>::rows)
      if (row.creep_law != nullptr)
        for (const CreepLawParameter &parameter : row.creep_law().parameters)
          if (declared.insert(parameter.name).second)
            of_creep
              .try_emplace(parameter.name,
                           parameter.standard,
                           material_formula(parameter.name, parameter.range))
              .first->second.add_parameter(
                parameter.name,
                parameter.meaning +
                  (". Allowed: a number " + (parameter.range.words + formula)),
                prm);
    viscosity_matrix.add_parameter(
      "Viscosity matrix",
      "Viscosity, in units of stress times time. Allowed: " + matrix,
      prm);
    viscosity_time_factor.add_parameter(
      "Viscosity time factor",
      "Factor of the viscosity, uniform in space." + factor,
      prm);
    chain_shift.add_parameter(
      "Chain shift",
      "Factor of all relaxation times of the chain, such as "
      "exp(-0.25*theta).",
      prm);
    chain.add_parameter(
      "Chain",
      "Maxwell bodies in parallel: for each its fraction of the stiffness and "
      "its relaxation time, in units of time. The rest of the stiffness is an "
      "elastic spring in parallel. Allowed: a list such as 0.5: 10; 0.3: 100, "
      "fractions greater than 0 with a sum of at most 1, relaxation times "
      "greater than 0" +
        formula,
      prm);
    prm.add_parameter(
      "Chain in shear only",
      chain_in_shear_only,
      "Whether the bodies of the chain creep at constant volume: their "
      "fractions are those of the shear modulus, and the bulk modulus stays "
      "elastic. Not for plane stress or Stiffness matrix.");
    mean_expansion_from.add_parameter(
      "Mean expansion from",
      "Temperature from which Thermal expansion is a mean coefficient, as "
      "handbooks give it. Needs Reference temperature. Empty: Reference "
      "temperature. Allowed: a number, or empty",
      prm);
    thermal_expansion.add_parameter(
      "Thermal expansion",
      "Thermal strain per change of temperature, in units of 1 / temperature: "
      "one value for isotropic expansion, or the components of the tensor, "
      "separated by commas: 11, 22, 12 (33 equals 11); 11, 22, 33, 12; or 11, "
      "22, 33, 12, 13, 23. Allowed: a number" +
        formula,
      prm);
  }



  std::vector<MaterialParameters::FreeStrain>
  MaterialParameters::free_strains() const
  {
    return {
      {"Thermal expansion", "thermal strain", thermal_expansion, true},
    };
  }

} // namespace Crevasse
