// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_harmonic_responses_h
#define crevasse_harmonic_balance_harmonic_responses_h

#include <crevasse/discretisation/algorithmic_moduli.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/harmonic_balance/complex_mumps.h>
#include <crevasse/harmonic_balance/lip_part.h>
#include <crevasse/harmonic_balance/periodic_contact.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /** The complex moduli K*ₙ of a harmonic. */
  template <int dim>
  using ComplexModuli = AlgorithmicModuli<dim, std::complex<double>>;

  /** Response of a body to nodal loads that oscillate at one frequency: the
   * solutions of A* q = b, with the complex stiffness A* = ∫ DᵀK*D. */
  struct HarmonicResponse
  {
    /** Compliance S = L A*⁻¹ Lᵀ on a part of the lip, the same on all ranks. */
    PeriodicContactProblem::Compliance compliance;

    /** Solves A* q = b: overwrites the parts of b by those of q. Collective. */
    std::function<void(Vector &real, Vector &imaginary)> solve;

    /** Bytes on this rank, without memory that responses share. */
    std::size_t memory_consumption;
  };

  /**
   * Computes the responses of a body to the harmonics in the cheapest way: by
   * back-solves with the elastic stiffness where K* is a multiple of K, by a
   * complex factor elsewhere. Factors are kept for their second use, as long as
   * the memory lasts.
   */
  template <int dim>
  class HarmonicResponses
  {
  public:
    /** The arguments must outlive the HarmonicResponses.
     *
     * @param linear_solver of the elastic stiffness A, without its factor k.
     * @param lip the nodes of the compliances.
     * @param memory in bytes, of all ranks. */
    HarmonicResponses(const Body<dim>          &body,
                      const MaterialState<dim> &material,
                      LinearSolver             &linear_solver,
                      const LipPart            &lip,
                      const double              memory)
      : body(body)
      , material(material)
      , linear_solver(linear_solver)
      , lip(lip)
      , memory(memory)
    {
    }

    /** Response to harmonic @p n with moduli and response without the factor k.
     * Collective. @throw NumericalError if MUMPS fails. */
    HarmonicResponse
    at(const unsigned int n, const ComplexModuli<dim> &moduli)
    {
      if (const auto found = kept.find(n); found != kept.end())
        return found->second;
      const auto             factor = common_factor(moduli,
                                        *material.stiffness,
                                        body.points.n_local_points,
                                        body.space.communicator());
      const HarmonicResponse response =
        factor ? scaled(*factor) : factorised(moduli);
      const double needed =
        dealii::Utilities::MPI::sum(double(response.memory_consumption),
                                    body.space.communicator());
      // The first responses are kept: they are used a second time in the same
      // order, so dropping the oldest would always drop the next.
      is_full = is_full || used_memory + needed > memory;
      if (!is_full)
        {
          used_memory += needed;
          kept[n] = response;
        }
      return response;
    }

    /** Response by a complex factor. Collective. @throw NumericalError */
    HarmonicResponse
    factorised(const ComplexModuli<dim> &moduli)
    {
      const std::size_t n_points = body.points.n_local_points;
      assemble_stiffness(body.space,
                         body.points,
                         part_of(moduli.sum, n_points, std::real),
                         real);
      if (imaginary.m() == 0)
        imaginary.reinit(real);
      assemble_stiffness(body.space,
                         body.points,
                         part_of(moduli.sum, n_points, std::imag),
                         imaginary);
      const auto factor = std::make_shared<ComplexMumps>(real,
                                                         imaginary,
                                                         lip.nodes.dofs,
                                                         ordering);
      ordering          = factor->ordering;
      ++n_factorisations;

      auto matrix =
        std::make_shared<dealii::FullMatrix<Complex>>(factor->compliance);
      for (unsigned int i = 0; i < lip.n_nodes(); ++i)
        for (unsigned int j = 0; j < lip.n_nodes(); ++j)
          (*matrix)(i, j) *= lip.nodes.sign[i] * lip.nodes.sign[j];
      const auto solve = [factor](Vector &real, Vector &imaginary) {
        factor->solve(real, imaginary);
      };
      return {{matrix, 1.}, solve, factor->memory_consumption()};
    }

    unsigned int n_factorisations = 0; ///< number of complex factors

  private:
    using Complex = std::complex<double>;

    /** Real or imaginary parts of matrices, as @p part extracts them. */
    static PointValues<VoigtMatrix<dim>>
    part_of(const PointValues<VoigtMatrix<dim, Complex>> &matrices,
            const std::size_t                             n_points,
            double (*part)(const Complex &))
    {
      return transform(
        matrices, n_points, [&](const VoigtMatrix<dim, Complex> &matrix) {
          VoigtMatrix<dim> result;
          for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
            for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
              result[i][j] = part(matrix[i][j]);
          return result;
        });
    }

    /** The common factor c with Σ K*ᵢ = c K at all points, if it exists: if the
     * relaxation time is the same everywhere, or if κ = 0. Collective. */
    static std::optional<Complex>
    common_factor(const ComplexModuli<dim>            &moduli,
                  const PointValues<VoigtMatrix<dim>> &stiffness,
                  const std::size_t                    n_points,
                  const MPI_Comm                       communicator)
    {
      constexpr double rounding = 1e-12;
      Complex          factor   = 0.;
      if (n_points > 0)
        factor = moduli.sum[0][0][0] / stiffness[0][0][0];
      // The factor of a point of the first rank that has points.
      const unsigned int rank =
        dealii::Utilities::MPI::this_mpi_process(communicator);
      const unsigned int first =
        dealii::Utilities::MPI::min(n_points > 0
                                      ? rank
                                      : dealii::numbers::invalid_unsigned_int,
                                    communicator);
      factor = dealii::Utilities::MPI::broadcast(communicator, factor, first);

      bool is_common = true;
      for (std::size_t p = 0; p < n_points && is_common; ++p)
        is_common = (moduli.sum[p] - factor * stiffness[p]).norm() <=
                    rounding * stiffness[p].norm() * std::abs(factor);
      if (dealii::Utilities::MPI::min(is_common ? 1 : 0, communicator) == 0)
        return {};
      return factor;
    }

    /** Response if A* is the elastic stiffness A times a number. */
    HarmonicResponse
    scaled(const std::complex<double> factor)
    {
      if (elastic_compliance == nullptr)
        {
          auto matrix = std::make_shared<dealii::FullMatrix<Complex>>();
          if (lip.n_nodes() > 0)
            *matrix =
              lip.compliance(linear_solver, body.space.ghosted_vector());
          elastic_compliance = matrix;
        }
      const Complex inverse = 1. / factor;
      const auto    solve   = [this, inverse](Vector &real, Vector &imaginary) {
        constexpr double accuracy = 1e-12; // relative residual
        const double     norm = std::max(real.l2_norm(), imaginary.l2_norm());
        if (norm == 0.)
          return;
        Vector of_real(real), of_imaginary(imaginary);
        of_real      = 0.;
        of_imaginary = 0.;
        linear_solver.solve(of_real, real, accuracy * norm);
        linear_solver.solve(of_imaginary, imaginary, accuracy * norm);
        real.equ(inverse.real(), of_real);
        real.add(-inverse.imag(), of_imaginary);
        imaginary.equ(inverse.real(), of_imaginary);
        imaginary.add(inverse.imag(), of_real);
      };
      return {{elastic_compliance, inverse}, solve, 0};
    }

    const Body<dim>          &body;
    const MaterialState<dim> &material;
    LinearSolver             &linear_solver;
    const LipPart            &lip;
    const double              memory;

    double       used_memory = 0.;
    bool         is_full     = false;
    SparseMatrix real, imaginary; ///< parts of the last A*
    std::shared_ptr<const dealii::FullMatrix<std::complex<double>>>
      elastic_compliance; ///< compliance L A⁻¹ Lᵀ
    std::shared_ptr<const std::vector<int>>  ordering; ///< shared ordering
    std::map<unsigned int, HarmonicResponse> kept;
  };
} // namespace Crevasse

#endif
