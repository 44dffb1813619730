// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_averaged_body_h
#define crevasse_periodic_averaged_body_h

#include <crevasse/contact/lip_shift.h>
#include <crevasse/periodic/averaged_material.h>
#include <crevasse/time/lip_history.h>

namespace Crevasse
{
  /**
   * A body whose fluidity is the mean over the period. The period map of the
   * body is close to that of the averaged one, whose fixed point is known: with
   * the change F = r(T) − r(0) of the viscous strain over a period and zᵢ = H̄ᵢ
   * wᵢK̄, it is reached by the step
   *
   *     δᵢ = Rᵢ + Dβ,     Rᵢ = Fᵢ − Dβ + zᵢ⁻¹ (Fᵢ − Dβ)
   *                              − ½ (1 + zᵢ/b)⁻¹ (Fᵢ − Dv) − Dw
   *
   * - β is the flow of the averaged body: P3 with a change γ of the mean
   *   contact forces ḡ, ᵗD Σ H̄ᵢ⁻¹ (Dβ − Fᵢ) = ᵗL γ, 0 ≤ Lβ ⟂ ḡ + γ ≥ 0.
   * - The third term, the second pole, makes the step that of relaxation over a
   *   whole period for zᵢ of any size, to 3 % instead of 30 %; v is the flow of
   *   the moduli wᵢK̄ (1 + zᵢ/b)⁻¹ where nodes that press in P3 are held.
   * - w is an elastic displacement: that of the nodes that press is −(c + Sγ)
   *   with the compliance S of the lip and the LipShift c that gives the mean
   *   contact forces ḡ + γ, so that R is the part of the step that bears
   *   stress: ᵗD Σ wᵢK̄ Rᵢ = 0 elsewhere.
   *
   * Where a chain has a spring, of the part w of the stiffness, nothing flows:
   * δᵢ = Fᵢ + zᵢ⁻¹ Fᵢ − ½ (…) + DB with ᵗD (wK̄ DB − Σ H̄ᵢ⁻¹ Fᵢ) = ᵗL γ, c = LB −
   * Sγ.
   *
   * Parts of the strain that do not flow, such as the volume of creep, get no
   * step: δ is made free of them by another displacement, whose moduli are
   * those of these parts alone.
   *
   * The strain Dβ without stress may flow on. Each fixed point is a periodic
   * motion of the body with its steps.
   */
  template <int dim>
  class AveragedBody
  {
  public:
    /** Averages the material, assembles and factorises. All arguments but the
     * last one must outlive this object. Collective.
     *
     * @param n_poles 1 or 2; 0 for jumps alone.
     * @param bounds of the lip; with a lip the linear solver must be direct.
     * @param stresses see AveragedMaterial. */
    AveragedBody(const Body<dim>         &body,
                 const Stages            &stages,
                 const UnilateralBounds  &bounds,
                 ContactSystemCache<dim> &systems,
                 const unsigned int       n_poles,
                 const StressHistory     &stresses);

    AveragedBody(const AveragedBody &) = delete;

    ~AveragedBody();

    /** Computes the step δ.
     *
     * @param increment F.
     * @param lip of the period of F; it is taken.
     * @param[out] step δ
     * @param[out] residual the part of δ that causes stress. */
    void
    find_step(const Vector &increment,
              LipHistory   &lip,
              Vector       &step,
              Vector       &residual);

    /** Change of the viscous strain over n periods, linearly implicit in their
     * number: with v of the moduli Mᵢ = wᵢK̄ (1/n + zᵢ)⁻¹, and the spring's,
     *
     *     δᵢ = Fᵢ + (n−1)/n [(1/n + zᵢ)⁻¹ (Fᵢ − Dv) + n Dv],
     *
     * whose contact forces are the mean ones of the lip shifted by
     * (n−1)/n (n Lv − Sγ). Exact for n = 1. Collective.
     *
     * @param increment F.
     * @param on_lip of the period of F: what was taken. */
    Vector
    jump(const Vector            &increment,
         const LipHistory::OnLip &on_lip,
         const unsigned int       n);

    /** Lip at the stages of the last period, which is forgotten; openings as
     * they would be without contact forces. Collective. */
    LipHistory::OnLip
    take(LipHistory &history) const;

    /** Removes from a strain what causes no stress where the lip is held.
     * Collective. */
    void
    remove_compatible(Vector &strain) const;

    /** Largest stress component that a viscous strain causes where the strain
     * is held. Collective. */
    double
    largest_stress(const Vector &strain) const;

    /** Number of periods whose LipShift was not found. */
    unsigned int
    n_unsolved() const
    {
      return shift ? shift->n_unsolved() : 0;
    }

  private:
    using Matrices   = typename MaterialState<dim>::Matrices;
    using LipVector  = LipShift::LipVector;
    using LipProblem = DirectSolver::LipProblem;
    using Set        = std::vector<bool>;

    /** A stiffness and its solver. */
    struct Part
    {
      std::vector<Matrices>               moduli; ///< Mᵢ of the branches
      ContactSystem<dim>                 *system = nullptr;
      std::unique_ptr<ContactSystem<dim>> own; ///< system, or null

      const dealii::LAPACKFullMatrix<double> &
      lip_stiffness() const
      {
        return dynamic_cast<const DirectSolver &>(system->linear_solver())
          .lip_stiffness();
      }
    };

    /** Assembles a part's stiffness. */
    void
    assemble(const Matrices &stiffness, Part &part);

    /** Assembles what finds β. */
    void
    prepare_flow();

    /** Prepares what belongs to the lip. */
    void
    prepare_lip();

    /** Displacement v with ᵗD Σ (A_part Dv − Mᵢ Fᵢ) = 0 off the lip.
     * @param strain F. @param on_lip determines v on the lip. */
    Vector
    solve(const Part       &part,
          const Vector     &strain,
          const LipProblem &on_lip) const;

    /** Adds f(branch, point, offset of its strain, Dv) to the strains of all
     * branches. */
    template <typename Function>
    void
    change(const Vector &displacement, Vector &values, const Function &f) const;

    /** Problem on the lip whose nodes have given values, except open ones. All
     * arguments must outlive it. */
    LipProblem
    holding(const Part &part, const Set &open, const LipVector &values) const;

    /** P3 on the lip. @param mean ḡ; by the solution ḡ + γ. */
    LipProblem
    flowing(LipVector &mean) const;

    /** A lip that moves with the flow. */
    struct Moving
    {
      double of_flow;  ///< displacement of the lip per v of its part
      double of_force; ///< the same of its compliance
      double part = 1.;
    };

    /** v on the lip that is shifted by c = part (of_flow v − Sγ), and so bears
     * ḡ + γ: as a chain's spring and jumps let it.
     *
     * @param compliance of the part's lip.
     * @param mean ḡ; by the solution ḡ + γ. All must outlive the problem. */
    LipProblem
    moving(const dealii::LAPACKFullMatrix<double> &compliance,
           const Moving                           &how,
           const std::vector<LipVector>           &openings,
           LipVector                              &mean) const;

    /** Stiffness of the part's lip along the lip's normals. */
    dealii::LAPACKFullMatrix<double>
    stiffness_along_normals(const Part &part) const;

    /** Moduli of jumps of n periods. */
    struct JumpPart
    {
      unsigned int                     n;
      Part                             part;
      dealii::LAPACKFullMatrix<double> compliance; ///< of its lip
    };

    const JumpPart &
    part_of_jump(const unsigned int n);

    /** Adds the counts of a part's own system to the run's. */
    void
    count(const Part &part) const;

    const Body<dim>            &body;
    const UnilateralBounds     &bounds;
    ContactSystemCache<dim>    &systems;
    SolverSettings              settings; ///< of own systems
    const Stages               &stages;
    const AveragedMaterial<dim> averaged;
    const double                spring;     ///< w; 0: there is none
    std::vector<Matrices>       compliance; ///< inverses of wᵢK̄
    Part                        elastic, flow, pole;
    Part                        rigid; ///< strains that do not flow, or none
    LipVector                   sign;  ///< signs of all bounds
    std::optional<LipShift>     shift; ///< none without contact
    std::deque<JumpPart>        jumps; ///< of the last jumps
  };
} // namespace Crevasse

#endif
