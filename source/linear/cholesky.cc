// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/linear/matrix_operator.h>
#include <crevasse/linear/supernodal_factor.h>

#include <deal.II/base/mpi.h>

#include <cholmod.h>
#include <map>
#include <optional>

namespace Crevasse
{
  using namespace dealii;

  struct Cholesky::Factor
  {
    Factor()
    {
      cholmod_start(&common);
      common.print = 0; // errors become exceptions
      // SupernodalFactor needs this format.
      common.supernodal = CHOLMOD_SUPERNODAL;
    }

    ~Factor()
    {
      cholmod_free_factor(&L, &common);
      cholmod_finish(&common);
    }

    Factor(const Factor &) = delete;

    void
    require_success() const
    {
      if (common.status < CHOLMOD_OK)
        throw NumericalError("CHOLMOD failed with status " +
                             std::to_string(common.status) +
                             (common.status == CHOLMOD_OUT_OF_MEMORY
                                ? ": the factor does not fit into memory."
                                : "."));
    }

    /** Orders and analyses @p A, with @p lip last. */
    void
    analyse(cholmod_sparse &A, const std::vector<int> &lip);

    /** Analyses @p A with this order, and keeps the analysis if it is the first
     * or has less fill. */
    void
    try_order(cholmod_sparse         &A,
              const std::vector<int> &candidate,
              const int               n_lip);

    /** Factorises @p A with an analysis. */
    void
    factorise(cholmod_sparse &A, const Factor &analysis);

    /** Unknown at each position in the factor. */
    const int *
    order() const
    {
      return static_cast<const int *>(L->Perm);
    }

    cholmod_common  common;
    cholmod_factor *L         = nullptr;
    double          n_entries = 0., n_operations = 0.; ///< size of an analysis

    std::optional<SupernodalFactor> substitution;
    std::vector<int>                lip_places; ///< positions of the lip
    LipVector                       on_lip;
    std::vector<double>             work; ///< vector in the factor's order
  };



  void
  Cholesky::Factor::try_order(cholmod_sparse         &A,
                              const std::vector<int> &candidate,
                              const int               n_lip)
  {
    const std::vector<int> lip(candidate.end() - n_lip, candidate.end());
    common.nmethods           = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    cholmod_factor *analysed  = nullptr;
    // Postordering enlarges supernodes; but with several parts of a body, the
    // lip of one part need not remain last.
    for (const bool sorted : {true, false})
      {
        common.postorder = sorted ? 1 : 0;
        cholmod_free_factor(&analysed, &common);
        analysed = cholmod_analyze_p(
          &A, const_cast<int *>(candidate.data()), nullptr, 0, &common);
        require_success();
        const int *const end = static_cast<int *>(analysed->Perm) + A.nrow;
        if (std::is_permutation(end - n_lip, end, lip.begin()))
          break;
      }
    if (L == nullptr || common.lnz < n_entries)
      {
        std::swap(L, analysed);
        n_entries    = common.lnz;
        n_operations = common.fl;
      }
    cholmod_free_factor(&analysed, &common);
  }



  void
  Cholesky::Factor::analyse(cholmod_sparse &A, const std::vector<int> &lip)
  {
    const int        n = A.nrow;
    std::vector<int> is_lip(n, 0), candidate(n);
    for (const int i : lip)
      is_lip[i] = 1;
    // Choice of the ordering, as in CHOLMOD: minimum degree is the fastest to
    // compute; nested dissection gives a smaller factor for large matrices
    // (measured: doc/contact_solvers.md) that minimum degree fills too much.
    constexpr int    large    = 30000;
    constexpr double much     = 500.; // operations for an entry of the factor
    constexpr double few_fill = 5.;   // entries for one of the matrix
    if (n <= large)
      {
        // CAMD requires unknowns off the lip.
        if (lip.size() == A.nrow)
          candidate = lip;
        else
          cholmod_camd(
            &A, nullptr, 0, is_lip.data(), candidate.data(), &common);
        require_success();
        try_order(A, candidate, lip.size());
        if (n_operations < much * n_entries ||
            n_entries < few_fill * common.anz)
          return;
      }
    std::vector<int> parents(n), members(n);
    cholmod_nested_dissection(&A,
                              nullptr,
                              0,
                              candidate.data(),
                              parents.data(),
                              members.data(),
                              &common);
    require_success();
    std::stable_partition(candidate.begin(), candidate.end(), [&](const int i) {
      return is_lip[i] == 0;
    });
    try_order(A, candidate, lip.size());
  }



  void
  Cholesky::require_one_process(const MPI_Comm communicator)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw SceneError(
        "[Linear solver] Type = cholesky works on one process only. Start the "
        "program without mpirun, or choose automatic, mumps, amg or gmg.");
  }



  Cholesky::Cholesky(const Matrix                 &matrix,
                     const Indices                &lip,
                     std::shared_ptr<const Factor> same_pattern)
    : DirectSolver(lip)
    , pattern(std::move(same_pattern))
    , factor(std::make_unique<Factor>())
  {
    require_one_process(matrix.get_mpi_communicator());

    // Row i of the symmetric matrix is CHOLMOD's column i; CHOLMOD reads its
    // upper triangle.
    const MatrixRows rows(matrix);
    cholmod_sparse   A{};
    A.nrow = A.ncol = rows.n;
    A.nzmax         = rows.starts[rows.n];
    A.p             = rows.starts;
    A.i             = rows.columns;
    A.x             = rows.values;
    A.stype = A.sorted = A.packed = 1;
    A.itype                       = CHOLMOD_INT;
    A.xtype                       = CHOLMOD_REAL;
    A.dtype                       = CHOLMOD_DOUBLE;
    if (pattern == nullptr)
      {
        auto analysis = std::make_shared<Factor>();
        analysis->analyse(A, {lip.begin(), lip.end()});
        pattern = analysis;
      }
    factor->factorise(A, *pattern);
    condense();
  }



  void
  Cholesky::Factor::factorise(cholmod_sparse &A, const Factor &analysis)
  {
    L = cholmod_copy_factor(analysis.L, &common);
    require_success();
    cholmod_factorize(&A, L, &common);
    require_success();
    if (common.status == CHOLMOD_NOT_POSDEF)
      throw NumericalError(
        "CHOLMOD: the stiffness is not positive definite (pivot " +
        std::to_string(L->minor) + " of " + std::to_string(A.nrow) +
        "). Check the moduli of [Material], the supports of [Boundary], and "
        "the mesh for inverted cells or unconnected parts.");
    substitution.emplace(*L);
    work.resize(A.nrow);
  }



  void
  Cholesky::condense()
  {
    const int                n = factor->work.size(), begin = n - lip.size();
    std::map<int, int>       place_of;
    LAPACKFullMatrix<double> rows(lip.size(), lip.size());
    for (int i = begin; i < n; ++i)
      place_of[factor->order()[i]] = i;
    const FullMatrix<double> triangle = factor->substitution->last_block(begin);
    for (unsigned int i = 0; i < lip.size(); ++i)
      {
        factor->lip_places.push_back(place_of.at(lip[i]));
        for (unsigned int j = 0; j < lip.size(); ++j)
          rows(i, j) = triangle(factor->lip_places[i] - begin, j);
      }
    factor->on_lip.reinit(lip.size());
    schur_complement.reinit(lip.size());
    if (!lip.empty())
      rows.mTmult(schur_complement, rows);
  }



  Cholesky::~Cholesky() = default;



  std::size_t
  Cholesky::memory_consumption() const
  {
    return factor->common.memory_inuse + schur_complement.memory_consumption();
  }



  std::string
  Cholesky::description() const
  {
    return "sparse Cholesky (CHOLMOD), " +
           std::to_string(std::size_t(pattern->n_entries)) +
           " entries in the factor";
  }



  void
  Cholesky::precondition(Vector &solution, const Vector &right_hand_side)
  {
    const int  n     = factor->work.size();
    double    *y     = factor->work.data();
    const int *order = factor->order();
    for (int i = 0; i < n; ++i)
      y[i] = right_hand_side.local_element(order[i]);
    factor->substitution->forward(y, n);
    factor->substitution->backward(y, n);
    for (int i = 0; i < n; ++i)
      solution.local_element(order[i]) = y[i];
  }



  void
  Cholesky::solve_with_lip(Vector           &solution,
                           const Vector     &right_hand_side,
                           const LipProblem &lip_problem)
  {
    const Stopwatch watch("linear solves");
    const int       n = factor->work.size(), begin = n - lip.size();
    double         *y     = factor->work.data();
    const int      *order = factor->order();
    for (int i = 0; i < n; ++i)
      y[i] = right_hand_side.local_element(order[i]);
    factor->substitution->forward(y, begin);
    for (unsigned int i = 0; i < lip.size(); ++i)
      factor->on_lip(i) = y[factor->lip_places[i]];
    lip_problem(factor->on_lip);
    for (unsigned int i = 0; i < lip.size(); ++i)
      y[factor->lip_places[i]] = factor->on_lip(i);
    factor->substitution->backward(y, begin);
    for (int i = 0; i < n; ++i)
      solution.local_element(order[i]) = y[i];
    ++solves;
  }
} // namespace Crevasse
