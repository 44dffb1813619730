// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The elastic state of a scene in the plane at the time 0, by PETSc's SNESVI
// (reduced space, MUMPS) with the matrix and the loads of the program. Prints
// unknowns, iterations, energy and the opening of the mouth.
// doc/figures/compare.py compares it with others:
//
//     snesvi SCENE.prm ["Section/Name=value" ...]

#include <crevasse/base/problems.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/scene_file.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <competitor.h>
#include <cstdio>

using namespace Crevasse;

int
main(int argc, char **argv)
{
  if (argc < 2)
    {
      std::fprintf(stderr, "snesvi SCENE.prm [\"Section/Name=value\" ...]\n");
      return 2;
    }
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  dealii::ParameterHandler prm;
  Problems                 problems;
  const Scene              scene =
    read_scene(argv[1], {argv + 2, argv + argc}, prm, problems);
  scene.check(problems);
  problems.throw_if_any();
  const Body<2> body(scene, make_scene_mesh<2>(scene, MPI_COMM_WORLD));

  SparseMatrix A;
  assemble_stiffness(body.space,
                     body.points,
                     *body.material.at(0.).stiffness,
                     A);
  const UnilateralBounds bounds = unilateral_bounds(body.lip, body.space);
  const SignoriniProblem problem(A, bounds);
  Vector                 b;
  body.strain_operator.initialize(b);
  body.loads.evaluate(0., b);

  Competitors competitors;
  add_petsc_competitors(competitors);
  Competitor &reduced_space = *competitors.front();
  reduced_space.prepare(problem, {}, scene.discretisation.degree);
  Vector q(b);
  q                          = 0.;
  const unsigned int n       = reduced_space.solve(b, q);
  double             opening = 0.;
  for (const auto &node : body.lip.nodes)
    if (std::abs(node.point[0] - scene.geometry.width) < 1e-9)
      opening = node.opening(q);
  std::printf("unknowns %u iterations %u energy %.12e opening %.12e\n",
              unsigned(A.m()),
              n,
              0.5 * (b * q),
              opening);
}
