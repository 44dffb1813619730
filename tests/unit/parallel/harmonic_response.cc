// The periodic state by harmonic balance: coefficients and samples, complex
// factors against what they replace, and periodic states against steps in real
// time, with and without contact.

#include <crevasse/base/log.h>
#include <crevasse/base/problems.h>
#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/harmonic_balance/harmonic_responses.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/time/evolution.h>

#include <complex>
#include <crevasse_tests/tests.h>
#include <iostream>
#include <sstream>

using namespace Crevasse;

namespace
{
  using Complex = std::complex<double>;

  void
  check_harmonics(const unsigned int n)
  {
    const Harmonics harmonics(3., n, HarmonicRule::trapezoid);
    std::vector<dealii::Vector<double>> samples(n, dealii::Vector<double>(2));
    for (unsigned int j = 0; j < n; ++j)
      {
        samples[j](0) = std::sin(7. * j * j + 1.);
        samples[j](1) = 2. + 3. * std::cos(4. * dealii::numbers::PI * j / n) -
                        5. * std::sin(4. * dealii::numbers::PI * j / n);
      }
    auto values = samples;
    harmonics.analyse(values);
    const double error = std::abs(values[0](1) - 2.) +
                         std::abs(values[3](1) - 3.) +
                         std::abs(values[4](1) - 5.);
    harmonics.synthesise(values);
    double difference = 0.;
    for (unsigned int j = 0; j < n; ++j)
      {
        values[j] -= samples[j];
        difference = std::max(difference, values[j].linfty_norm());
      }
    const std::string name = std::to_string(n) + " instants: ";
    check_below(name + "coefficients of a known harmonic", error, 1e-13);
    check_below(name + "samples of the coefficients", difference, 1e-13);
  }



  /** A body, what solves for it, and its periodic state. */
  struct Run
  {
    Run(const Scene &scene, const MPI_Comm communicator)
      : scene(scene)
      , log(communicator, true)
      , body(this->scene, make_scene_mesh<2>(this->scene, communicator))
      , steps(scene.time_integration, scene.loads.period)
      , systems(this->scene,
                body,
                choose_solvers(this->scene, body),
                steps,
                largest_load(body, steps),
                log)
      , result(solve_fourier_problem<2>(this->scene, body, steps, systems, 1.))
      , evolution(body.strain_operator, body.points, body.loads, systems)
    {
      if (result.flow)
        evolution.split_off(*result.flow);
    }

    /** By how much the implicit trapezoidal rule, from one sample, misses the
     * next one, relative to the largest change; the largest of all steps. */
    double
    miss_of_trapezoidal_rule()
    {
      const auto &r = result.motion.viscous_strain;
      Vector      rate(r[0]), next(r[0]);
      double      miss = 0., size = 0.;
      for (unsigned int j = 0; j < r.size(); ++j)
        {
          const double half = 0.5 * steps.step(j);
          const double t    = steps.within_period(steps.instant(j + 1));
          evolution.rate(steps.instant(j), r[j], rate);
          next = r[j];
          next.add(half, rate);
          evolution.implicit_rate(t, next, half, rate);
          next.add(half, rate);
          rate = r[j];
          rate -= r[0];
          size = std::max(size, rate.linfty_norm());
          next -= r[(j + 1) % r.size()];
          miss = std::max(miss, next.linfty_norm());
        }
      return miss / size;
    }

    /** How far displacement gradients and contact forces are from what the
     * variational inequality has for each sample of r. */
    void
    check_samples(const std::string &name)
    {
      double q_miss = 0., q_size = 0., g_miss = 0.;
      Vector rate(result.motion.viscous_strain[0]);
      for (unsigned int j = 0; j < steps.n_steps(); ++j)
        {
          evolution.rate(steps.instant(j),
                         result.motion.viscous_strain[j],
                         rate);
          Vector difference = evolution.state().displacement;
          q_size            = std::max(q_size, difference.linfty_norm());
          difference -= result.motion.displacement[j];
          q_miss = std::max(q_miss, difference.linfty_norm());
          for (unsigned int k = 0; k < body.lip.nodes.size(); ++k)
            {
              const double g = evolution.state().contact_forces.normal[k];
              g_miss =
                std::max(g_miss,
                         std::abs(g - result.motion.contact_forces[j][k]));
            }
        }
      check_below(name + ": displacements of the samples, relative error",
                  q_miss / q_size,
                  1e-11);
      check_below(name + ": contact forces of the samples, relative to loads",
                  dealii::Utilities::MPI::max(g_miss,
                                              body.space.communicator()) /
                    systems.settings.largest_load,
                  1e-11);
    }

    const Scene           scene;
    Log                   log;
    const Body<2>         body;
    const StepList        steps;
    ContactSystemCache<2> systems;
    const FourierResult   result;
    Evolution<2>          evolution;
  };



  Scene
  edge_crack(const std::string &traction, const std::string &relaxation_time)
  {
    Scene scene;
    scene.geometry.subdivisions             = "8, 4";
    scene.material.young_modulus            = "13000*(1 + x)";
    scene.material.poisson_ratio            = "0.2";
    scene.material.relaxation_time          = relaxation_time;
    scene.loads.period                      = 600.;
    scene.loads.traction                    = traction;
    scene.time_integration.steps_per_period = 16;
    return scene;
  }



  const char *const sine     = "0; 10*sin(2*pi*t/600)";
  const char *const pressing = "0; 10*sin(2*pi*t/600) + 3*cos(4*pi*t/600) - 4";



  void
  check_states(const MPI_Comm communicator)
  {
    const auto check_run =
      [&](const std::string &name, const Scene &scene, const bool is_scaled) {
        Run         run(scene, communicator);
        const auto &motion = run.result.motion;
        check_below(name + ": miss of the trapezoidal rule",
                    run.miss_of_trapezoidal_rule(),
                    1e-11);
        run.check_samples(name);
        check(name + ": factors are complex where they must be",
              (motion.complex_factorisations == 0) == is_scaled);
      };

    Scene scene = edge_crack(sine, "60*(1 + 4*y)");
    check_run("no mean load", scene, false);
    Run open(edge_crack("0; 10*sin(2*pi*t/600) + 4", "60"), communicator);
    open.check_samples("lip open in the mean");
    check("lip open in the mean: a flow, but no node to solve for",
          open.result.flow && open.result.motion.instants_of_contact.empty());
    check_run("contact", edge_crack(pressing, "60*(1 + 4*y)"), false);
    check_run("contact, one relaxation time", edge_crack(pressing, "60"), true);

    scene                                   = edge_crack(pressing, "60");
    scene.time_integration.steps_per_period = 15;
    scene.material.stiffness_time_factor    = "2";
    scene.material.viscosity_time_factor    = "3";
    scene.material.plane_state              = PlaneState::plane_strain;
    scene.material.viscosity                = ViscosityType::isotropic;
    scene.material.viscous_modulus          = "60*13000";
    scene.material.viscous_poisson_ratio    = "0.4";
    scene.material.thermal_expansion        = "1e-5";
    scene.loads.temperature                 = "50*x*sin(2*pi*t/600) + 20*y";
    check_run("thermal strain, odd number of steps, factors", scene, false);

    scene                    = edge_crack(pressing, "60");
    scene.material.viscosity = ViscosityType::chain;
    scene.material.chain     = "0.25: 30; 0.75: 200*(1 + y)";
    scene.boundary.gap       = "-1e-4";
    check_run("chain, gap", scene, false);

    scene.material.chain = "0.5: 60"; // and a spring
    check_run("a spring", scene, true);
  }



  /** A complex factor where back-solves with A would do. */
  void
  check_complex_factor()
  {
    Run                    run(edge_crack(sine, "60"), MPI_COMM_SELF);
    const auto            &body     = run.body;
    const std::size_t      n_points = body.points.n_local_points;
    const MaterialState<2> material = body.material.at(0.);
    const Complex          kappa(0., -3.);
    const ComplexModuli<2> moduli(material, kappa, n_points);

    const auto           bounds = unilateral_bounds(body.lip, body.space);
    const LipPart        lip(MPI_COMM_SELF,
                      bounds,
                      std::vector<bool>(bounds.dofs.size(), true));
    HarmonicResponses<2> responses(
      body, material, run.systems.system_at(0.).linear_solver(), lip, 0.);
    const auto scaled = responses.at(1, moduli);

    const auto factorised = responses.factorised(moduli);
    // With the ordering of the first one.
    const auto again       = responses.factorised(moduli);
    const auto n_of_scaled = responses.n_factorisations - 2;

    Vector load[2], q[3][2];
    for (unsigned int part = 0; part < 2; ++part)
      {
        body.strain_operator.initialize(load[part]);
        body.loads.evaluate(50. + 300. * part, load[part]);
        for (auto &solution : q)
          solution[part] = load[part];
      }
    scaled.solve(q[0][0], q[0][1]);
    factorised.solve(q[1][0], q[1][1]);
    again.solve(q[2][0], q[2][1]);
    const auto S = scaled.compliance, S_factorised = factorised.compliance;
    double     S_miss = 0., S_size = 0.;
    for (unsigned int i = 0; i < lip.n_nodes(); ++i)
      for (unsigned int j = 0; j < lip.n_nodes(); ++j)
        {
          const Complex value = S.factor * (*S.matrix)(i, j);
          S_size              = std::max(S_size, std::abs(value));
          S_miss =
            std::max(S_miss, std::abs(value - (*S_factorised.matrix)(i, j)));
        }
    for (unsigned int k = 1; k < 3; ++k)
      for (unsigned int part = 0; part < 2; ++part)
        {
          q[k][part] -= q[0][part];
          check_below(std::string(k == 1 ? "complex factor"
                                         : "with the same ordering") +
                        (part == 0 ? ", real" : ", imaginary") +
                        " displacement: relative error",
                      q[k][part].linfty_norm() / q[0][part].linfty_norm(),
                      1e-11);
        }
    check("complex factor for one relaxation time was not made",
          n_of_scaled == 0);
    check_below("complex factor, compliance: relative error",
                S_miss / S_size,
                1e-11);
  }



  /** With factors that are not kept, and on one rank alone, all is the same. */
  void
  check_ranks_and_memory()
  {
    Scene scene = edge_crack(pressing, "60*(1 + 4*y)");
    Run   alone(scene, MPI_COMM_SELF);
    scene.linear_solver.memory_for_instants = 0.;
    Run all(scene, MPI_COMM_WORLD);
    check("without memory each harmonic is factorised twice",
          all.result.motion.complex_factorisations ==
            2 * alone.result.motion.complex_factorisations);
    double worst = 0.;
    for (unsigned int j = 0; j < all.steps.n_steps(); ++j)
      {
        // r of both is laid out by cells, in another order: norms are not.
        const auto norm = [j](const Run &run) {
          return run.result.motion.viscous_strain[j].l2_norm();
        };
        worst = std::max(worst, std::abs(norm(all) / norm(alone) - 1.));
      }
    check_below("all ranks and one: norms of the viscous strain", worst, 1e-11);
  }



  /** As good as the loads are smooth, here as their samples are many. */
  void
  check_exact_rule()
  {
    // A homogeneous body without contact: u = u_el [F + ∫F/τ], so that at t =
    // 0, where F = 0, q is −T/(2πτ) u_el of F = 1 but for a constant.
    Scene scene                    = edge_crack(sine, "60");
    scene.material.young_modulus   = "13000";
    scene.periodic_state.harmonics = HarmonicRule::exact;
    Run         run(scene, MPI_COMM_SELF);
    const auto &q    = run.result.motion.displacement;
    Vector      loss = q[0], elastic = q[4];
    loss -= q[8];
    elastic -= q[12];
    elastic *= 600. / (2. * dealii::numbers::PI * 60.);
    loss += elastic;
    check_below("exact rule: known answer to a sine",
                loss.linfty_norm() / elastic.linfty_norm(),
                1e-11);
  }



  void
  check_refusals()
  {
    const auto refusal = [](const Scene &scene) {
      try
        {
          const Body<2>  body(scene, make_scene_mesh<2>(scene, MPI_COMM_WORLD));
          const StepList steps(scene.time_integration, scene.loads.period);
          require_fourier(scene, body, steps);
        }
      catch (const SceneError &error)
        {
          return std::string(error.what());
        }
      return std::string();
    };
    const auto check_refusal =
      [&](const std::string &name, const Scene &scene, const char *advice) {
        check("refused with advice: " + name,
              refusal(scene).find(advice) != std::string::npos);
      };
    const Scene good = edge_crack(sine, "60");
    check("a good scene is not refused", refusal(good).empty());
    Scene scene                  = good;
    scene.material.young_modulus = "13000 + t";
    check_refusal("varying stiffness", scene, "Method = anderson");
    scene                                = good;
    scene.material.viscosity_time_factor = "1 + t/600";
    check_refusal("varying viscosity", scene, "Method = anderson");
    scene                                = good;
    scene.material.plane_state           = PlaneState::plane_strain;
    scene.material.viscosity             = ViscosityType::isotropic;
    scene.material.viscous_poisson_ratio = "0.5";
    check_refusal("singular fluidity", scene, "singular");
    scene                    = good;
    scene.material.viscosity = ViscosityType::none;
    check_refusal("no viscosity", scene, "Method = march");
    scene                               = good;
    scene.time_integration.step_control = StepControlType::adaptive;
    check_refusal("adaptive steps", scene, "Step control = uniform");
  }
} // namespace

void
harmonic_response()
{
  check_harmonics(8);
  check_harmonics(9);
  check_complex_factor();
  check_states(MPI_COMM_WORLD);
  check_ranks_and_memory();
  check_exact_rule();
  check_refusals();
}
