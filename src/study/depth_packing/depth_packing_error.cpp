#include "ninebit/study/depth_packing_error.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <new>

#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr std::uint32_t kOne = 0x3F800000;  // the bits of 1.0F; smaller floats >= 0 have smaller bits
constexpr std::uint64_t kChunk = 1U << 16;  // depths per task
constexpr std::uint64_t kBatch = 1U << 12;  // depths that are packed at once, on the stack

// The set of floats in [0, 2) that have been seen: one bit each.
class SeenFloats {
 public:
  // calloc: the memory is 128 MiB, and few of its pages are touched.
  // NOLINTBEGIN(cppcoreguidelines-no-malloc)
  SeenFloats() : words_(static_cast<std::uint64_t*>(std::calloc(kWords, sizeof(std::uint64_t)))) {
    if (words_ == nullptr) throw std::bad_alloc();
  }
  ~SeenFloats() { std::free(words_); }
  // NOLINTEND(cppcoreguidelines-no-malloc)
  SeenFloats(const SeenFloats&) = delete;
  SeenFloats& operator=(const SeenFloats&) = delete;

  // Adds floats, as one operation for neighbours in the same word.
  class Adder {
   public:
    explicit Adder(SeenFloats& seen) : seen_(seen) {}
    ~Adder() { seen_.add(index_, bits_); }
    Adder(const Adder&) = delete;
    Adder& operator=(const Adder&) = delete;
    void add(float value) {
      const std::uint32_t bits = std::bit_cast<std::uint32_t>(value) & (kFloats - 1);
      if (bits / 64 != index_) {
        seen_.add(index_, bits_);
        index_ = bits / 64;
        bits_ = 0;
      }
      bits_ |= std::uint64_t{1} << bits % 64;
    }

   private:
    SeenFloats& seen_;
    std::uint32_t index_ = 0;
    std::uint64_t bits_ = 0;
  };

  [[nodiscard]] std::uint64_t count() const {
    std::uint64_t n = 0;
    for (std::size_t block = 0; block < touched_.size(); ++block) {
      if (touched_[block] == 0) continue;
      const std::uint64_t* const words = words_ + block * kBlock;
      for (std::size_t i = 0; i < kBlock; ++i) n += static_cast<std::uint64_t>(std::popcount(words[i]));
    }
    return n;
  }

 private:
  static constexpr std::uint32_t kFloats = 1U << 30;  // below 2.0F, which no packing reaches
  static constexpr std::size_t kWords = kFloats / 64;
  static constexpr std::size_t kBlock = 512;  // words: a page

  void add(std::size_t index, std::uint64_t bits) {
    std::atomic_ref<std::uint64_t> word(words_[index]);
    if ((bits & ~word.load(std::memory_order_relaxed)) == 0) return;
    word.fetch_or(bits, std::memory_order_relaxed);
    std::atomic_ref<char>(touched_[index / kBlock]).store(1, std::memory_order_relaxed);
  }

  std::uint64_t* words_;
  std::vector<char> touched_ = std::vector<char>(kWords / kBlock);  // true for each block with a set bit
};

// The errors of a range of depths. Sums of doubles depend on their order, so ranges are joined from first to last.
struct RangeErrors {
  std::uint64_t exact = 0, inversions = 0;
  double sum = 0.0, sum_of_sizes = 0.0, largest = -1.0;
  float worst_depth = 0.0F, worst_back = 0.0F;
};

}  // namespace

std::string_view name_of(DepthSet set) {
  return set == DepthSet::bits16 ? "16" : set == DepthSet::bits24 ? "24" : "floats";
}

std::uint64_t depth_count(DepthSet set, std::uint32_t float_step) {
  if (set == DepthSet::bits16) return 1U << 16;
  if (set == DepthSet::bits24) return 1U << 24;
  return (std::uint64_t{kOne} + float_step - 1) / float_step + 1;
}

float depth_at(DepthSet set, std::uint32_t float_step, std::uint64_t i) {
  if (set == DepthSet::bits16) return static_cast<float>(static_cast<double>(i) / 65535.0);
  if (set == DepthSet::bits24) return static_cast<float>(static_cast<double>(i) / 16777215.0);
  return std::bit_cast<float>(static_cast<std::uint32_t>(std::min<std::uint64_t>(i * float_step, kOne)));
}

Result<RoundTripError> measure_round_trip(const DepthPacking& packing, ChannelStorage storage, DepthSet set,
                                          std::uint32_t float_step, const GoOn& go_on) {
  const auto back_of = [&](float depth) { return read_depth(packing, store_depth(packing, depth, storage), storage); };
  const std::uint64_t depths = depth_count(set, float_step);
  std::vector<RangeErrors> stretches((depths + kChunk - 1) / kChunk);
  SeenFloats seen;
  std::atomic<bool> stopped = false;
  parallel_for(stretches.size(), [&](std::size_t s) {
    if (stopped || (go_on && !go_on())) {
      stopped = true;
      return;
    }
    SeenFloats::Adder adder(seen);
    const std::uint64_t first = s * kChunk, last = std::min(first + kChunk, depths);
    float before = back_of(depth_at(set, float_step, first == 0 ? 0 : first - 1));
    adder.add(before);
    RangeErrors here;
    std::array<float, kBatch> from{}, to{};
    for (std::uint64_t begin = first; begin < last; begin += kBatch) {
      const std::size_t count = std::min(kBatch, last - begin);
      for (std::size_t i = 0; i < count; ++i) from[i] = depth_at(set, float_step, begin + i);
      packing.round_trips(std::span(from).first(count), storage, std::span(to).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        const float depth = from[i], back = to[i];
        const double error = static_cast<double>(back) - static_cast<double>(depth), size = std::fabs(error);
        here.exact += back == depth ? 1U : 0U;
        here.inversions += back < before ? 1U : 0U;
        if (back != before) adder.add(back);
        before = back;
        if (depth >= 1.0F) continue;
        here.sum += error;
        here.sum_of_sizes += size;
        if (size > here.largest) {
          here.largest = size;
          here.worst_depth = depth;
          here.worst_back = back;
        }
      }
    }
    stretches[s] = here;
  });
  if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};

  RoundTripError out;
  out.depths = depths;
  out.distinct = seen.count();
  out.zero_back = back_of(0.0F);
  out.one_back = back_of(1.0F);
  out.max_error = -1.0;
  for (const RangeErrors& s : stretches) {
    out.exact += s.exact;
    out.inversions += s.inversions;
    out.mean_error += s.sum_of_sizes;
    out.mean_bias += s.sum;
    if (s.largest > out.max_error) {
      out.max_error = s.largest;
      out.worst_depth = s.worst_depth;
      out.worst_back = s.worst_back;
    }
  }
  // Only the last depth of each set is 1.
  out.mean_error /= static_cast<double>(depths - 1);
  out.mean_bias /= static_cast<double>(depths - 1);
  return out;
}

TwoDigits store_two_digits(const DepthPacking& packing, ChannelStorage storage, int highest, int second) {
  const float depth = static_cast<float>(highest * 256 + second) / 65536.0F;
  const DepthBytes bytes = store_depth(packing, depth, storage);
  const auto last = static_cast<std::size_t>(packing.channels - 1);
  const double error = static_cast<double>(read_depth(packing, bytes, storage)) - static_cast<double>(depth);
  return {.highest_byte = bytes[packing.red_is_highest ? 0 : last],
          .second_byte = bytes[packing.red_is_highest ? 1 : last - 1],
          .shift = error * 65536.0};
}

}  // namespace ninebit
