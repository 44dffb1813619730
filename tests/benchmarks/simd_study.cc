// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// What SIMD would add to StiffnessOperator: its loop in 3D, in one thread, over
// 1, 2, 4 and 8 cells at once. Not part of the build, since it instantiates
// batches that deal.II's library does not have (5 minutes, 2 GB):
//
//     mpicxx -std=c++17 -O3 -mavx2 -mfma -DNDEBUG -DBOOST_NO_AUTO_PTR
//       -I/usr/include/{trilinos,hdf5/openmpi,suitesparse,petsc,slepc}
//       simd_study.cc -o simd_study -Wl,--copy-dt-needed-entries -ldeal.ii
//       -ltbb
//     ./simd_study [refinements of 27 cubes [distortion]]
//
// Without -mavx2 -mfma, batches of 1 are what Debian's deal.II offers now.

#include <deal.II/base/config.h>

// The default of VectorizedArray, which is part of the library's interface, was
// set by then: only what names its width is wider.
#undef DEAL_II_VECTORIZATION_WIDTH_IN_BITS
#if defined(__AVX512F__)
#  define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 512
#elif defined(__AVX__)
#  define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 256
#else
#  define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 128
#endif
#define FE_EVAL_FACTORY_DEGREE_MAX 2

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/matrix_free/evaluation_template_factory.templates.h>
#include <deal.II/matrix_free/evaluation_template_factory_hanging_nodes.templates.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/mapping_info.templates.h>
#include <deal.II/matrix_free/matrix_free.templates.h>
#include <deal.II/matrix_free/shape_info.templates.h>
// The guard of the next file is that of the one for cells.
#undef dealii_matrix_free_evaluation_template_factory_templates_h
#include <deal.II/matrix_free/evaluation_template_face_factory.templates.h>

#include <iostream>

using namespace dealii;

namespace
{
  enum class Moduli
  {
    one,       ///< K of the body
    lanes,     ///< K of each point, read as StiffnessOperator does
    transposed ///< likewise, by vectorized_load_and_transpose()
  };

  struct Problem
  {
    Triangulation<3>                           mesh;
    DoFHandler<3>                              dofs{mesh};
    LinearAlgebra::distributed::Vector<double> result;   ///< of the first row
    double                                     rate = 0; ///< likewise
  };

  /** Prints a row of the table; stops if the product is another one. */
  template <typename Number, std::size_t width, int degree, Moduli kind>
  void
  measure(Problem &problem)
  {
    using Lanes  = VectorizedArray<Number, width>;
    using Loops  = MatrixFree<3, Number, Lanes>;
    using Vector = LinearAlgebra::distributed::Vector<Number>;
    constexpr unsigned int n_points = Utilities::pow(degree + 1, 3);
    constexpr unsigned int n_moduli = 21;

    Loops                          loops;
    typename Loops::AdditionalData data;
    data.mapping_update_flags  = update_gradients | update_JxW_values;
    data.tasks_parallel_scheme = Loops::AdditionalData::none;
    loops.reinit(MappingQ1<3>(),
                 problem.dofs,
                 AffineConstraints<Number>(),
                 QGauss<1>(degree + 1),
                 data);

    // In the order of the loop, which is kind to the caches.
    std::vector<Number> moduli;
    for (unsigned int q = 0; q < loops.n_cell_batches() * width * n_points; ++q)
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          moduli.push_back((i < 3 ? .6 : 0.) + (i == j) * (i < 3 ? .4 : .2));
    const auto apply = [&](const Loops                                 &loops,
                           Vector                                      &result,
                           const Vector                                &v,
                           const std::pair<unsigned int, unsigned int> &cells) {
      FEEvaluation<3, degree, degree + 1, 3, Number, Lanes> evaluation(loops);
      std::array<Lanes, 6>                                  strain;
      SymmetricTensor<2, 3, Lanes>                          stress;
      std::array<Lanes, n_moduli>                           of_lanes;
      std::array<unsigned int, width>                       first;
      const auto multiply = [&](const auto *packed) {
        for (unsigned int i = 0, k = 0; i < 6; ++i, ++k)
          {
            stress.access_raw_entry(i) = packed[k + i] * strain[i];
            for (unsigned int j = 0; j < i; ++j, ++k)
              {
                stress.access_raw_entry(i) += packed[k] * strain[j];
                stress.access_raw_entry(j) += packed[k] * strain[i];
              }
          }
      };
      for (unsigned int batch = cells.first; batch < cells.second; ++batch)
        {
          for (unsigned int lane = 0; lane < width; ++lane)
            first[lane] = (batch * width + lane) * n_points * n_moduli;
          evaluation.reinit(batch);
          evaluation.gather_evaluate(v, EvaluationFlags::gradients);
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const auto gradient = evaluation.get_symmetric_gradient(q);
              for (unsigned int i = 0; i < 6; ++i)
                strain[i] =
                  Number(i < 3 ? 1. : 2.) * gradient.access_raw_entry(i);
              const Number *of_cell_0 = &moduli[q * n_moduli];
              if constexpr (kind == Moduli::one)
                multiply(moduli.data());
              else if constexpr (width == 1)
                multiply(of_cell_0 + first[0]);
              else if constexpr (kind == Moduli::transposed)
                vectorized_load_and_transpose(n_moduli,
                                              of_cell_0,
                                              first.data(),
                                              of_lanes.data());
              else
                for (unsigned int lane = 0;
                     lane < loops.n_active_entries_per_cell_batch(batch);
                     ++lane)
                  for (unsigned int k = 0; k < n_moduli; ++k)
                    of_lanes[k][lane] = of_cell_0[first[lane] + k];
              if constexpr (kind != Moduli::one && width > 1)
                multiply(of_lanes.data());
              evaluation.submit_symmetric_gradient(stress, q);
            }
          evaluation.integrate_scatter(EvaluationFlags::gradients, result);
        }
    };

    Vector v, result;
    loops.initialize_dof_vector(v);
    loops.initialize_dof_vector(result);
    for (unsigned int i = 0; i < v.size(); ++i)
      v(i) = std::sin(1. * i);
    double best = 0.;
    for (Timer all; all.wall_time() < 2.;)
      {
        Timer timer;
        loops.template cell_loop<Vector, Vector>(apply, result, v, true);
        best = std::max(best, v.size() / timer.wall_time() / 1e6);
      }
    if (problem.rate == 0.)
      problem.rate = best;
    if (problem.result.size() == 0)
      problem.result = result;
    LinearAlgebra::distributed::Vector<double> difference;
    difference = result;
    difference -= problem.result;
    const auto error = difference.linfty_norm() / problem.result.linfty_norm();
    constexpr const char *kinds[] = {"one", "of points", "transposed"};
    std::cout << "| Q" << degree << " | " << v.size() / 1000 << " | "
              << kinds[int(kind)] << " | " << 8 * sizeof(Number) << " | "
              << width << " | " << best << " | " << best / problem.rate << " | "
              << error << " |" << std::endl;
    AssertThrow(error < (sizeof(Number) == 8 ? 1e-13 : 1e-5),
                ExcInternalError());

    constexpr bool is_widest =
      64 * width == DEAL_II_VECTORIZATION_WIDTH_IN_BITS;
    using Next = std::conditional_t<is_widest, float, double>;
    if constexpr (std::is_same_v<Number, double>)
      measure<Next, 2 * width, degree, kind>(problem);
  }

  template <int degree>
  void
  measure_degree(const unsigned int refinements, const double distortion)
  {
    Problem problem;
    GridGenerator::subdivided_hyper_cube(problem.mesh, 3);
    problem.mesh.refine_global(refinements);
    GridTools::distort_random(distortion, problem.mesh);
    problem.dofs.distribute_dofs(FESystem<3>(FE_Q<3>(degree), 3));
    measure<double, 1, degree, Moduli::one>(problem);
    problem.rate = 0.;
    measure<double, 1, degree, Moduli::lanes>(problem);
    measure<double, 2, degree, Moduli::transposed>(problem);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int refinements = argc > 1 ? std::stoi(argv[1]) : 4;
  const double       distortion  = argc > 2 ? std::stod(argv[2]) : 0.;
  std::cout << "| element | 10³ unknowns | K | bits | cells at once | "
               "10⁶ unknowns/s | ratio | difference |\n"
               "|---|---|---|---|---|---|---|---|\n";
  std::cout.precision(3);
  measure_degree<1>(refinements, distortion);
  measure_degree<2>(refinements - 1, distortion);
}
