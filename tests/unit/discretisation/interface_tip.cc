// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Auxiliary fields between two bodies: those of one body if both are the same,
// and mirror images if the bodies change places.

#include <crevasse/crack_tip/interface_tip.h>

#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  /** Isotropic stiffness in plane stress or strain. */
  VoigtMatrix<2>
  stiffness(const double mu, const double lambda)
  {
    VoigtMatrix<2> K;
    for (const unsigned int c : {0, 1})
      {
        K[c][0] = K[c][1] = lambda;
        K[c][c] += 2. * mu;
      }
    K[3][3] = mu;
    return K;
  }



  /** Largest difference of the factors of strain, stress and force. */
  double
  difference(const AuxiliaryField &a, const AuxiliaryField &b)
  {
    return std::max({(a.of_strain - b.of_strain).norm(),
                     (a.of_stress[0] - b.of_stress[0]).norm(),
                     (a.of_force[0] - b.of_force[0]).norm()});
  }



  /** The field of one body, with factors as those of InterfaceTip. */
  AuxiliaryField
  of_one_body(const CrackTip         &tip,
              const CrackMode         mode,
              const dealii::Point<2> &local,
              const SquareWeight     &weight,
              const double            kappa)
  {
    AuxiliaryField field(tip, mode, local, weight);
    field.of_stress[0] += kappa * field.of_stress[1];
    field.of_force[0] += kappa * field.of_force[1];
    field.of_stress[0] *= 4. / (kappa + 1.);
    field.of_force[0] *= 4. / (kappa + 1.);
    return field;
  }



  /** The field reflected at the crack's line. */
  AuxiliaryField
  reflected(AuxiliaryField field)
  {
    field.of_strain[3] *= -1.;
    field.of_stress[0][3] *= -1.;
    field.of_force[0][1] *= -1.;
    return field;
  }
} // namespace

void
interface_tip()
{
  CrackTip tip;
  tip.ahead    = dealii::Tensor<1, 2>({1., 0.});
  tip.inward   = dealii::Tensor<1, 2>({0., 1.});
  tip.two_lips = true;
  const SquareWeight weight{2., 3};
  const auto         stiff = stiffness(3., 2.), soft = stiffness(1., 0.5);
  const InterfaceTip one({{soft, soft}}, 1.), two({{stiff, soft}}, 0.7),
    swapped({{soft, stiff}}, 0.7);
  const PlaneElasticity body(soft);
  double                equal = 0., mirrored = 0., closed = 0.;
  for (const CrackMode mode : {CrackMode::opening, CrackMode::sliding})
    for (const dealii::Point<2> &local : {dealii::Point<2>(0.3, 0.4),
                                          dealii::Point<2>(0.3, -0.4),
                                          dealii::Point<2>(-1.2, 0.),
                                          dealii::Point<2>(-1.2, -0.),
                                          dealii::Point<2>(-0.01, -0.02)})
      {
        const dealii::Point<2> image(local[0], -local[1]);
        equal = std::max(
          equal,
          difference(one.auxiliary(tip, mode, local, weight, false),
                     of_one_body(tip, mode, local, weight, body.kappa())));
        const AuxiliaryField other =
          reflected(swapped.auxiliary(tip, mode, image, weight, false));
        AuxiliaryField sum = two.auxiliary(tip, mode, local, weight, false);
        sum.add(mode == CrackMode::opening ? -1. : 1., other);
        mirrored = std::max(mirrored, difference(sum, {}));
        if (mode == CrackMode::sliding)
          closed = std::max(
            closed,
            difference(one.auxiliary(tip, mode, local, weight, true),
                       one.auxiliary(tip, mode, local, weight, false)));
      }
  check_below("equal bodies have the fields of one", equal, 1e-11);
  check_below("bodies that change places have mirrored fields",
              mirrored,
              1e-11);
  check_below("closed lips between equal bodies have mode II", closed, 1e-11);
  check_below("oscillating index of equal bodies",
              std::abs(one.epsilon()),
              1e-15);
}
