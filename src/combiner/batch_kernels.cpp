// The vector operations of vector_code.h, in 16-bit lanes where those suffice. They give the bits of arithmetic.inl's
// rules by other formulas. The comments here prove that these are exact, and tests try every input.
#include "src/combiner/batch_kernels.h"

#include <algorithm>
#include <cstddef>

#include "src/numerics/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/combiner/batch_kernels.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/combiner/batch_products-inl.h"
#include "src/combiner/batch_sources-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <int kTerms, bool kFloors>
class Affine {
 public:
  explicit HWY_INLINE Affine(const Formula& f)
      : factor0_(set(f.factor[0])), factor1_(set(f.factor[1])), offset_(set(f.offset)) {}
  template <class X>
  HWY_INLINE V16 operator()(const X& x, std::size_t lane) const {
    const V16 sum = hn::Add(hn::Mul(x.get(0, lane), factor0_), offset_);
    return kTerms == 2 ? hn::Add(sum, hn::Mul(x.get(1, lane), factor1_)) : sum;
  }

 private:
  V16 factor0_, factor1_, offset_;
};

template <int kTerms, bool kFloors, bool kClamps>
HWY_NOINLINE void affine(const Operations& operations, const Batch& batch) {
  const Affine<kTerms, kFloors> sum(operations.first->formula);
  const Clamp clamp(operations.first->formula);
  for_lanes<kTerms, kFloors ? kAllFloors : kPlain>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const V16 v = sum(x, lane);
    return kClamps ? clamp(v) : v;
  });
}

// The sum of two values: what color sums and sums of products by one are.
template <bool kFloors>
HWY_NOINLINE void sum(const Operations& operations, const Batch& batch) {
  const Clamp clamp(operations.first->formula);
  for_lanes<2, kFloors ? kAllFloors : kPlain>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    return clamp(hn::Add(x.get(0, lane), x.get(1, lane)));
  });
}

// The offset less or plus one value.
template <bool kFloors, bool kMinus>
HWY_NOINLINE void shifted(const Operations& operations, const Batch& batch) {
  const V16 offset = set(operations.first->formula.offset);
  for_lanes<1, kFloors ? kAllFloors : kPlain>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    return kMinus ? hn::Sub(offset, x.get(0, lane)) : hn::Add(offset, x.get(0, lane));
  });
}

// Halves up is a shift of the value plus one; toward zero adds the one to negative values only.
template <int kTerms>
HWY_NOINLINE void half_of_affine(const Operations& operations, const Batch& batch) {
  const Affine<kTerms, true> sum(operations.first->formula);
  const Clamp clamp(operations.first->formula);
  const bool nearest = operations.first->formula.nearest;
  for_lanes<kTerms, kAllFloors>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const V16 v = sum(x, lane);
    const V16 more = nearest ? set(1) : hn::BitCast(kD16, hn::ShiftRight<15>(hn::BitCast(kU16, v)));
    return clamp(hn::ShiftRight<1>(hn::Add(v, more)));
  });
}

template <bool kFloors>
HWY_NOINLINE void select(const Operations& operations, const Batch& batch) {
  const V16 limit = set(operations.first->formula.low);
  for_lanes<3, kFloors ? kAllFloors : kPlain>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    return hn::IfThenElse(hn::Lt(x.get(0, lane), limit), x.get(1, lane), x.get(2, lane));
  });
}

template <bool kFloors>
HWY_NOINLINE void select_odd(const Operations& operations, const Batch& batch) {
  for_lanes<3, kFloors ? kAllFloors : kPlain>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    return hn::IfThenElse(hn::TestBit(x.get(0, lane), set(1)), x.get(2, lane), x.get(1, lane));
  });
}

template <bool kFloors>
HWY_NOINLINE void copy(const Operations& operations, const Batch& batch) {
  for_lanes<1, kFloors ? kAllFloors : kPlain>(operations, batch,
                                              [&](const auto& x, std::size_t lane) HWY_ATTR { return x.get(0, lane); });
}

template <bool kFloors>
HWY_INLINE Run affine_of(const Formula& f) {
  if (f.halves) return f.terms == 1 ? half_of_affine<1> : half_of_affine<2>;
  if (f.terms == 2) {
    if (f.factor[0] == 1 && f.factor[1] == 1 && f.offset == 0) return sum<kFloors>;
    return f.clamps() ? affine<2, kFloors, true> : affine<2, kFloors, false>;
  }
  if (f.clamps()) return affine<1, kFloors, true>;
  if (f.factor[0] == 1 && f.offset == 0) return copy<kFloors>;
  return f.factor[0] == 1    ? shifted<kFloors, false>
         : f.factor[0] == -1 ? shifted<kFloors, true>
                             : affine<1, kFloors, false>;
}

// Not inlined: its choices are long.
HWY_NOINLINE Run kernel_of(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  const bool floors = f.floors != 0;
  switch (f.kernel) {
    case Kernel::affine:
      return floors ? affine_of<true>(f) : affine_of<false>(f);
    case Kernel::unsigned_products:
      return f.terms == 1   ? unsigned_products_of<1>(operation)
             : f.terms == 2 ? unsigned_products_of<2>(operation)
                            : unsigned_products_of<3>(operation);
    case Kernel::signed_product:
      return signed_product_of(operation);
    case Kernel::signed_sum:
      return f.terms == 1 ? signed_sum_of<1>(operation) : signed_sum_of<2>(operation);
    case Kernel::products:
      return products_of(operation);
    case Kernel::select:
      return floors ? select<true> : select<false>;
    case Kernel::select_odd:
      return floors ? select_odd<true> : select_odd<false>;
    case Kernel::copy:
      break;
  }
  return copy<false>;
}

void prepare_code(VectorCode& code) {
  code.prepared_for = HWY_TARGET;
  code.kernels.clear();
  for (const VectorOperation& operation : code.operations) {
    code.kernels.push_back(reinterpret_cast<AnyKernel>(kernel_of(operation)));
  }
}

// 32 KiB, or as many as one step of the most temporaries takes, of which there are never more than 512 (60 a stage).
constexpr std::size_t kTemporaryLanes = std::max<std::size_t>(16384, 512 * kLanesAStep);
constexpr unsigned kBatchShift = 9;
static_assert(kBatchSize == std::size_t{1} << kBatchShift);

void run_code(const VectorCode& code, RegisterBatch& registers, std::size_t count, OutputBatch& out) {
  alignas(64) s9 temporaries[kTemporaryLanes];
  // As many lanes at once as leave room for all temporaries.
  unsigned shift = kBatchShift;
  while ((code.temporaries << shift) > kTemporaryLanes) --shift;
  // Beside planes that are written; no operation writes these. NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  s9* const constants = const_cast<s9*>(code.constants.empty() ? nullptr : code.constants[0].lane.data());
  Batch batch{{registers.plane[0][0].data(), out.plane[0].data(), constants, temporaries},
              {kBatchShift, kBatchShift, kBatchShift, shift},
              0};
  const bool is_prepared = code.prepared_for == HWY_TARGET;
  for (std::size_t first = 0; first < count; first += batch.lanes) {
    batch.lanes = std::min(std::size_t{1} << shift, count - first);
    for (std::size_t i = 0; i < code.operations.size(); i += code.operations[i].alike) {
      const VectorOperation& operation = code.operations[i];
      const Run run = is_prepared ? reinterpret_cast<Run>(code.kernels[i]) : kernel_of(operation);
      run({&operation, operation.alike}, batch);
    }
    batch.base[0] += batch.lanes;
    batch.base[1] += batch.lanes;
  }
}

}  // namespace ninebit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {
namespace detail {
HWY_EXPORT(prepare_code);
HWY_EXPORT(run_code);

void prepare_vector_code(VectorCode& code) {
  HWY_DYNAMIC_DISPATCH(prepare_code)(code);
}

void run_vector_code(const VectorCode& code, RegisterBatch& registers, std::size_t count, OutputBatch& out) {
  HWY_DYNAMIC_DISPATCH(run_code)(code, registers, count, out);
}
}  // namespace detail

const char* simd_target() {
  // Highway numbers targets so that the lowest set bit is the best one.
  const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(usable & -usable);
}

}  // namespace ninebit
#endif
