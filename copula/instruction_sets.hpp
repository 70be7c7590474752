#pragma once
/// The instruction sets that vector kernels are compiled for, the widest of which is chosen at run time: to be included
/// before Highway's headers.

#include <hwy/base.h>

#if HWY_ARCH_X86 && !defined(HWY_DISABLED_TARGETS)
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SSSE3)  // they differ in instructions that are not used here
#endif
