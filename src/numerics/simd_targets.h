// The SIMD targets that files with vectors are compiled for. Included before hwy/foreach_target.h.
#pragma once

// SVE and RVV: some kernels keep vectors as members of objects, which vectors of a size unknown to the compiler do not
// allow. SSSE3: processors that have it and lack SSE4.1 are from 2006 and 2007; one target less compiles a fifth
// faster.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3)
#endif
