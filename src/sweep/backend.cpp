// SPDX-License-Identifier: Apache-2.0
#include "sweep/backend.h"

#include "sweep/cpu/match_cpu.h"
#include "sweep/reference/match_reference.h"

namespace skysweep::sweep {

const char* to_string(Backend backend) {
  switch (backend) {
    case Backend::reference: return "reference";
    case Backend::cpu: return "cpu";
  }
  return "unknown";
}

MatchResult match_planes(const SweepProblem& problem, Backend backend, Executor& executor) {
  return backend == Backend::reference ? reference::match_planes(problem, executor)
                                       : cpu::match_planes(problem, executor);
}

}  // namespace skysweep::sweep
