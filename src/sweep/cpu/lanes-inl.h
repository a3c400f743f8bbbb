// SPDX-License-Identifier: Apache-2.0
// The vectors that all kernels of the CPU backend work with: at most one segment of cells wide.
// Included once for every instruction set (Highway's per-target idiom, hence the guard that toggles).
#if defined(SKYSWEEP_SWEEP_CPU_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYSWEEP_SWEEP_CPU_LANES_INL_H_
#undef SKYSWEEP_SWEEP_CPU_LANES_INL_H_
#else
#define SKYSWEEP_SWEEP_CPU_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "sweep/cpu/view_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kSegmentCells>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;

// What was stored before is loaded from memory after: lanes taken one by one come cheaper that way than by the shuffles
// with which compilers would save the store.
template <typename T>
HWY_INLINE const T* reloaded(const T* stored) {
#if HWY_COMPILER_GCC || HWY_COMPILER_CLANG
  asm volatile("" : "+r"(stored) : : "memory");
#endif
  return stored;
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYSWEEP_SWEEP_CPU_LANES_INL_H_
