// THE rules of fragments, written once, a file each. No include guard: one_fragment.h includes them for one fragment,
// fragment_vector-inl.h for a vector of fragments on every SIMD target.
//
// The includer provides the macro NINEBIT_RULE (the functions' attributes). Each rule takes a value domain `o`, which
// has these members:
//
//   V, F, FM      types: 32-bit integers, floats, truth values
//   V set(int); F set(float)
//   V or F add, sub; V min_of, max_of, shift_left, shift_right, bits_and, bits_or
//   V bits_and_not(V x, V y)                       y without the bits of x
//   V or F mul
//   F div, negated, abs_of, floor_of
//   V saturated_sum, saturated_difference          of numbers from 0 to 65,535, clamped to these
//   FM less, equal, greater_equal, less_equal, all, any
//   FM without(FM x, FM y)                         y and not x
//   F select(FM choice, F yes, F no)
//   V number_where(FM choice, int yes, V no)
//   V or F where(FM choice, V or F yes)            else 0

#include "src/raster/rules/blended.inl"
#include "src/raster/rules/cube_face.inl"
#include "src/raster/rules/depth_code.inl"
#include "src/raster/rules/eight_bit_weights.inl"
#include "src/raster/rules/stencil_operation.inl"
#include "src/raster/rules/stored_color.inl"
#include "src/raster/rules/top_left.inl"
