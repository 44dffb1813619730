// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/exact_stage.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/sundials/n_vector.h>

#include <arkode/arkode_arkstep.h>

namespace Crevasse
{
  using dealii::SUNDIALS::internal::unwrap_nvector;
  using dealii::SUNDIALS::internal::unwrap_nvector_const;

  namespace
  {
    // To ARKODE what is negative is a failure that no other step mends. (The
    // names that SUNDIALS has for them differ between its releases.)
    constexpr int solved = 0, not_solved = -1;
  } // namespace



  ExactStage::ExactStage(const Solve &solve, const SUNContext context)
    : solve(solve)
    , handle(SUNNonlinSolNewEmpty(context))
  {
    AssertThrow(handle != nullptr, dealii::ExcOutOfMemory(0));
    handle->content = this;
    // One that needs no linear solver of ARKODE's.
    handle->ops->gettype = [](SUNNonlinearSolver) {
      return SUNNONLINEARSOLVER_FIXEDPOINT;
    };
    // The system is known without that.
    handle->ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) {
      return solved;
    };
    handle->ops->solve = [](SUNNonlinearSolver self,
                            N_Vector,
                            N_Vector correction,
                            N_Vector,
                            sunrealtype,
                            sunbooleantype,
                            void *arkode_memory) {
      return static_cast<ExactStage *>(self->content)
        ->solve_stage(arkode_memory, correction);
    };
  }



  ExactStage::~ExactStage()
  {
    SUNNonlinSolFreeEmpty(handle);
  }



  int
  ExactStage::solve_stage(void *arkode_memory, N_Vector correction)
  {
    double   t, c;
    N_Vector predicted, state, implicit_rate, data;
    void    *user_data;
    if (ARKStepGetNonlinearSystemData(arkode_memory,
                                      &t,
                                      &predicted,
                                      &state,
                                      &implicit_rate,
                                      &c,
                                      &data,
                                      &user_data) < 0)
      return not_solved;
    known = *unwrap_nvector_const<Vector>(predicted);
    known += *unwrap_nvector_const<Vector>(data);
    rate.reinit(known, true);
    if (solve(t, known, c, rate) != 0)
      return not_solved;
    Vector &z_c = *unwrap_nvector<Vector>(correction);
    z_c         = *unwrap_nvector_const<Vector>(data);
    z_c.add(c, rate);
    return solved;
  }
} // namespace Crevasse
