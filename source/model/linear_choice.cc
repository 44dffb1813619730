// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/machine_memory.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/parameters/automatic.h>

#include <deal.II/base/utilities.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Number of entries in so many rows of a stiffness: on average 3 (degree
     * 1) or 4 (degree 2) nodes along each direction share a cell with a node,
     * each with dim components. */
    template <int dim>
    double
    n_matrix_entries(const double n_rows, const unsigned int degree)
    {
      return n_rows * dim * Utilities::fixed_power<dim>(degree + 2.);
    }



    /** Largest number of entries of a process for ML, which counts with 32
     * bits: 0.9e9 corrupted memory (Trilinos 13.2), 0.5e9 worked. */
    constexpr double most_entries_of_ml = 0.5e9;



    template <int dim>
    void
    require_work_for_ml(const Scene       &scene,
                        const double       n_own_unknowns,
                        const double       n_unknowns,
                        const unsigned int n_ranks)
    {
      const double entries =
        n_matrix_entries<dim>(n_own_unknowns, scene.discretisation.degree);
      if (entries <= most_entries_of_ml)
        return;
      throw SceneError(
        "[Linear solver] Type: amg fails beyond about " +
        std::to_string(std::lround(1e-6 * most_entries_of_ml)) +
        " million entries of the stiffness on a process; this mesh has about " +
        std::to_string(std::lround(1e-6 * entries)) + " million (" +
        Text::from_number(n_unknowns) + " unknowns). " +
        (scene.contact.needs_matrix() ? "Set [Contact] Solver = automatic "
                                        "without Relaxation table, and use"
                                      : "Use") +
        " Type = gmg with fewer [Geometry] Subdivisions and "
        "more Refinements, or at least " +
        std::to_string(
          std::lround(std::ceil(n_ranks * entries / most_entries_of_ml))) +
        " processes.");
    }
  } // namespace



  template <int dim>
  double
  n_unknowns_of_first_mesh(const Body<dim> &body)
  {
    return double(dim) * Utilities::pow(body.space.finite_element.degree, dim) *
           body.space.mesh().n_cells(0);
  }



  namespace
  {
    /** Whether [Linear solver] Type = gmg is possible and pays on a mesh with
     * levels: nothing needs a matrix, and the first mesh has few enough
     * unknowns, @p n_coarsest, for a factorisation. */
    bool
    may_use_gmg(const Scene       &scene,
                const unsigned int dimension,
                const double       n_coarsest)
    {
      return singular_functions(scene).n == 0 &&
             !scene.contact.needs_matrix() &&
             n_coarsest <= largest_factorised(dimension);
    }



    template <int dim>
    LinearSolverChoice
    choose_linear(const Scene &scene, const Body<dim> &body)
    {
      const MPI_Comm     communicator = body.space.communicator();
      const auto         n_unknowns   = body.space.n_unknowns();
      const unsigned int n_ranks =
        Utilities::MPI::n_mpi_processes(communicator);
      const LinearSolverChoice choice = choose_linear_solver(
        scene.linear_solver,
        dim,
        n_unknowns,
        n_ranks,
        body.space.mesh().n_global_levels() > 1 &&
          may_use_gmg(scene, dim, n_unknowns_of_first_mesh(body)));
      if (choice.type == LinearSolverType::cholesky)
        Cholesky::require_one_process(communicator);
      if (choice.type == LinearSolverType::amg)
        require_work_for_ml<dim>(
          scene,
          Utilities::MPI::max(double(
                                body.space.locally_owned_unknowns.n_elements()),
                              communicator),
          n_unknowns,
          n_ranks);
      if (traits(choice.type).has(Trait::is_multigrid) &&
          body.space.singular_shapes() != nullptr)
        throw SceneError(
          "[Discretisation] Singular functions: must be 0 on a mesh that is "
          "too large for a direct solver (" +
          std::to_string(n_unknowns) +
          " unknowns), or set [Linear solver] Type = cholesky or mumps.");
      return choice;
    }



    /** The solver for contact with friction. */
    ContactSolverChoice
    choose_for_friction(const ContactSolverType solver,
                        const LinearSolverType  linear_solver)
    {
      using Type = ContactSolverType;
      if (traits(linear_solver).has(Trait::is_multigrid))
        throw SceneError(
          "[Boundary] Friction coefficient: friction needs a factorisation. "
          "Set [Linear solver] Type = cholesky or mumps.");
      if (solver != Type::automatic && solver != Type::condensed_active_set)
        throw SceneError("[Contact] Solver = " + name_of(solver) +
                         ": is for contact without friction. Use automatic.");
      return {Type::condensed_active_set,
              "friction is solved on the lip alone"};
    }



    ContactSolverChoice
    choose_contact(const ContactParameters        &parameters,
                   const LinearSolverType          linear_solver,
                   const std::size_t               n_bounds,
                   const std::vector<RigidMotion> &held_by_contact)
    {
      using Type               = ContactSolverType;
      const bool must_condense = !held_by_contact.empty();
      if (must_condense && (traits(linear_solver).has(Trait::is_multigrid) ||
                            (parameters.solver != Type::automatic &&
                             parameters.solver != Type::condensed_active_set)))
        throw SceneError(
          "[Contact] Solver: " + what_contact_holds(held_by_contact) +
          ", so that without contact it has no equilibrium. Set Solver = "
          "condensed active set and [Linear solver] Type = cholesky or mumps, "
          "or hold the body by [Boundary] Clamped, Symmetry or Fixed points.");
      if (parameters.solver == Type::condensed_active_set && n_bounds > 0 &&
          traits(linear_solver).has(Trait::is_multigrid))
        throw SceneError(
          "[Contact] Solver = condensed active set needs a factorisation. Set "
          "[Linear solver] Type = cholesky or mumps, or Solver = active set.");
      if (parameters.solver != Type::automatic)
        return {parameters.solver,
                "[Contact] Solver = " + name_of(parameters.solver)};

      // Dense matrices of the condensed problem grow with the square of the
      // lip, the work on them with its cube (measured: doc/contact_solvers.md).
      constexpr std::size_t largest_lip = 10000;
      const std::string     n           = std::to_string(largest_lip);
      if (traits(linear_solver).has(Trait::is_multigrid))
        return {Type::active_set,
                "automatic: the linear solver makes no factor, which "
                "condensation needs"};
      if (must_condense)
        return {Type::condensed_active_set,
                "automatic: contact alone holds parts of the body"};
      if (n_bounds > largest_lip)
        return {Type::active_set,
                "automatic: the lip has more than " + n + " nodes"};
      return {Type::condensed_active_set,
              "automatic: a factor, and a lip of at most " + n + " nodes"};
    }
  } // namespace



  template <int dim>
  SolverChoice
  choose_solvers(const Scene &scene, const Body<dim> &body)
  {
    const MPI_Comm    communicator = body.space.communicator();
    const std::size_t n_bounds =
      Utilities::MPI::sum(body.lip.nodes.size(), communicator);
    const LinearSolverChoice  linear = choose_linear(scene, body);
    const ContactSolverChoice contact =
      body.friction ? choose_for_friction(scene.contact.solver, linear.type)
                    : choose_contact(scene.contact,
                                     linear.type,
                                     n_bounds,
                                     body.held_by_contact);
    if (!body.held_by_contact.empty() &&
        (scene.output.elastic_comparison == ComparedLip::open ||
         !scene.contact.relaxation_table.empty()))
      throw SceneError(
        "[Output] Elastic comparison = open and [Contact] Relaxation table "
        "solve for the body without contact, but " +
        what_contact_holds(body.held_by_contact) +
        ". Leave both out, or hold the body by [Boundary] Clamped, Symmetry or "
        "Fixed points.");
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        if (contact.type == ContactSolverType::projected_sor && n_bounds > 0)
          throw SceneError(
            "[Contact] Solver = projected sor works on one process only. Set "
            "Solver = automatic, or start the program without mpirun.");
        if (!scene.contact.relaxation_table.empty())
          throw SceneError(
            "[Contact] Relaxation table: the table is of projected SOR, which "
            "works on one process only. Leave it empty, or start the program "
            "without mpirun.");
      }
    return {linear, contact};
  }



  template <int dim>
  double
  bytes_of_solver(const LinearSolverType type,
                  const double           n_unknowns,
                  const double           n_coarsest,
                  const unsigned int     degree,
                  const unsigned int     n_ranks)
  {
    using Choice = LinearSolverType;
    if (type == Choice::gmg)
      return sizeof(double) * (degree == 1 ? 60. : 25.) * n_unknowns +
             bytes_of_solver<dim>(
               choose_matrix_solver(dim, n_coarsest, n_ranks).type,
               n_coarsest,
               0.,
               degree,
               n_ranks);

    // Each entry stores a value and a column.
    const double matrix = (sizeof(double) + sizeof(int)) *
                          n_matrix_entries<dim>(n_unknowns, degree);
    if (type == Choice::amg)
      return 2. * matrix;
    const double factor =
      dim == 2 ? 127. * n_unknowns * std::log2(std::max(n_unknowns, 2.))
               : 190. * std::pow(n_unknowns, 4. / 3.);
    const double of_mumps = dim == 2 ? 1.3 : 2.1;
    return matrix + (type == Choice::mumps ? of_mumps : 1.) * factor;
  }



  template <int dim>
  void
  require_room(const Scene      &scene,
               const CellCounts &cells,
               const MPI_Comm    communicator)
  {
    const unsigned int n_ranks  = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int degree   = scene.discretisation.degree;
    const double       per_cell = dim * std::pow(degree, dim);
    const double       unknowns = per_cell * cells.all;
    const double       coarsest = per_cell * cells.first;
    // A mesh without levels is its own first mesh: if a factorisation fits on
    // it, memory is hardly short.
    const LinearSolverChoice solver =
      choose_linear_solver(scene.linear_solver,
                           dim,
                           unknowns,
                           n_ranks,
                           may_use_gmg(scene, dim, coarsest));
    if (solver.type == LinearSolverType::amg)
      require_work_for_ml<dim>(scene, unknowns / n_ranks, unknowns, n_ranks);

    // Less than for any measured mesh; each rank stores the whole first mesh.
    constexpr double bytes_per_cell = dim == 2 ? 250. : 400.;
    const double     needed =
      bytes_per_cell * cells.first +
      (bytes_per_cell * cells.all +
       bytes_of_solver<dim>(solver.type, unknowns, coarsest, degree, n_ranks)) /
        n_ranks;
    require_memory(
      needed,
      0.,
      unknowns,
      communicator,
      "[Geometry]: a mesh of about " + Text::from_number(cells.all) +
        " cells (" + Text::from_number(unknowns) +
        " unknowns), with the linear solver " + solver.describe() + ",",
      "Use fewer Subdivisions or Refinements; in three dimensions fewer "
      "Subdivisions, more Refinements and [Linear solver] Type = gmg; or "
      "processes on more machines.");
  }



#define INSTANTIATE(dim)                                                 \
  template decltype(n_unknowns_of_first_mesh<dim>)                       \
                                          n_unknowns_of_first_mesh<dim>; \
  template decltype(choose_solvers<dim>)  choose_solvers<dim>;           \
  template decltype(bytes_of_solver<dim>) bytes_of_solver<dim>;          \
  template decltype(require_room<dim>)    require_room<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
