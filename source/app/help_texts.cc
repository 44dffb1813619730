// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/help_texts.h>

namespace Crevasse
{
  // The text lists the values of ExitStatus.
  const char *const examples_and_statuses = R"(Examples:
  crevasse prm/raous1980.prm --set "Geometry/Crack length=0.3" --output results/short_crack
  crevasse advise prm/raous1980.prm --error 1e-3
  crevasse report results/raous1980
  crevasse sweep --help

Exit status:
  0  done
  2  bad command line, parameter, expression or mesh, found before computing
  3  numerical failure (no convergence, unstable step, rigid motion);
     also if the stress is not periodic after Maximum periods; all
     results are written
  4  cannot read or write a file
  5  stopped on request (SIGTERM, SIGINT, SIGHUP, --wall-time, a file
     "stop" in the output directory), checkpoint written: continue with --resume)";



  const char *const what_to_do_next =
    R"(Crevasse computes periodic states of cracked viscoelastic solids, from a scene file:

  crevasse prm/raous1980.prm       run a scene, here the paper's example
  crevasse --check SCENE.prm       effects, sizes and memory of a scene, without a run
  crevasse --print-parameters      all parameters with their defaults
  crevasse report DIR              one page of the results
  crevasse sweep --help            results over parameters; what accuracy costs
  crevasse advise --help           the cheapest settings for an accuracy
  crevasse --help                  all options

doc/getting_started.md tells more.
)";
} // namespace Crevasse
