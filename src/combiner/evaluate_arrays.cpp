#include "ninebit/combiner/evaluate_arrays.h"

#include <algorithm>
#include <cstring>

#include "src/combiner/array_kernels.h"

namespace ninebit {
namespace {

constexpr std::ptrdiff_t kCodeBytes = sizeof(s9);

std::ptrdiff_t bytes_of(ElementType type) {
  return type == ElementType::byte ? 1 : kCodeBytes;
}

// A sample at any address: the caller's arrays need not be aligned.
s9 sample_at(const std::byte* at, ElementType type) {
  if (type == ElementType::byte) return static_cast<s9>(*at);
  s9 code = 0;
  std::memcpy(&code, at, sizeof code);
  return code;
}

// Whether the first `components` of them lie one beside the other, fragment after fragment.
template <class Samples>
bool is_interleaved(const std::array<Samples, 4>& of, std::size_t components, ElementType type) {
  const std::ptrdiff_t bytes = bytes_of(type);
  for (std::size_t c = 0; c < components; ++c) {
    if (of[c].first == nullptr || of[c].type != type) return false;
    if (of[c].stride != bytes * static_cast<std::ptrdiff_t>(components)) return false;
    const auto* const expected = static_cast<const std::byte*>(of[0].first) + static_cast<std::ptrdiff_t>(c) * bytes;
    if (of[c].first != expected) return false;
  }
  return reinterpret_cast<std::uintptr_t>(of[0].first) % (type == ElementType::code ? alignof(s9) : 1) == 0;
}

const std::byte* at(const InputArray& samples, std::size_t fragment) {
  return static_cast<const std::byte*>(samples.first) + static_cast<std::ptrdiff_t>(fragment) * samples.stride;
}
std::byte* at(const OutputArray& samples, std::size_t fragment) {
  return static_cast<std::byte*>(samples.first) + static_cast<std::ptrdiff_t>(fragment) * samples.stride;
}

// A plane of codes as a compiler knows it.
bool are_codes_together(const InputArray& samples) {
  return samples.type == ElementType::code && samples.stride == kCodeBytes &&
         reinterpret_cast<std::uintptr_t>(samples.first) % alignof(s9) == 0;
}

void load(const InputArray& from, std::size_t begin, std::size_t count, s9* to) {
  const std::byte* sample = at(from, begin);
  if (from.type == ElementType::byte && from.stride == 1) {
    return detail::load_bytes(reinterpret_cast<const std::uint8_t*>(sample), count, to);
  }
  if (from.type == ElementType::code && from.stride == kCodeBytes) {
    std::memcpy(to, sample, count * sizeof(s9));
    return;
  }
  for (std::size_t i = 0; i < count; ++i, sample += from.stride) to[i] = sample_at(sample, from.type);
}

void store(const s9* from, std::size_t begin, std::size_t count, const OutputArray& to) {
  std::byte* sample = at(to, begin);
  if (to.type == ElementType::code && to.stride == kCodeBytes) {
    std::memcpy(sample, from, count * sizeof(s9));
    return;
  }
  for (std::size_t i = 0; i < count; ++i, sample += to.stride) {
    if (to.type == ElementType::byte) {
      *sample = static_cast<std::byte>(from[i]);
    } else {
      std::memcpy(sample, from + i, sizeof(s9));
    }
  }
}

// The samples of one register that the program reads and that differ from fragment to fragment.
class RegisterInput {
 public:
  RegisterInput(const std::array<InputArray, 4>& samples, const detail::ComponentPlanes& read)
      : samples_(&samples), read_(read) {
    using detail::load_rgb8, detail::load_rgba8, detail::load_rgba16;
    if (is_interleaved(samples, 4, ElementType::byte)) {
      load_bytes_ = load_rgba8;
    } else if (is_interleaved(samples, 4, ElementType::code)) {
      load_codes_ = load_rgba16;
    } else if (is_interleaved(samples, 3, ElementType::byte)) {
      load_bytes_ = load_rgb8;
      together_ = 3;
    }
    if (load_bytes_ == nullptr && load_codes_ == nullptr) together_ = 0;
  }

  void take(std::size_t begin, std::size_t count) const {
    const std::byte* const first = at((*samples_)[0], begin);
    if (load_bytes_ != nullptr) load_bytes_(reinterpret_cast<const std::uint8_t*>(first), count, read_);
    if (load_codes_ != nullptr) load_codes_(reinterpret_cast<const s9*>(first), count, read_);
    for (std::size_t c = together_; c < 4; ++c) {
      if (read_[c] != nullptr) load((*samples_)[c], begin, count, read_[c]);
    }
  }

 private:
  const std::array<InputArray, 4>* samples_;
  detail::ComponentPlanes read_;
  void (*load_bytes_)(const std::uint8_t*, std::size_t, const detail::ComponentPlanes&) = nullptr;
  void (*load_codes_)(const s9*, std::size_t, const detail::ComponentPlanes&) = nullptr;
  std::size_t together_ = 4;  // components that these load
};

void store_all(const std::array<const s9*, 4>& from, std::size_t begin, std::size_t count,
               const std::array<OutputArray, 4>& to) {
  if (is_interleaved(to, 4, ElementType::byte)) {
    return detail::store_rgba8(from, count, reinterpret_cast<std::uint8_t*>(at(to[0], begin)));
  }
  if (is_interleaved(to, 4, ElementType::code)) {
    return detail::store_rgba16(from, count, reinterpret_cast<s9*>(at(to[0], begin)));
  }
  for (std::size_t c = 0; c < 4; ++c) {
    if (to[c].first != nullptr) store(from[c], begin, count, to[c]);
  }
}

bool is_wanted(const std::array<OutputArray, 4>& outputs) {
  return std::any_of(outputs.begin(), outputs.end(), [](const OutputArray& to) { return to.first != nullptr; });
}

// The batches of a range: what is the same in all of them is filled in once, unless a batch changes it.
class Batches {
 public:
  Batches(const BatchProgram& program, const FragmentArrays& samples, RegisterBatch& registers) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      detail::ComponentPlanes varying{};
      for (std::size_t c = 0; c < 4; ++c) {
        // A register that the program never touches is still the caller's, where it is wanted.
        const bool needed = program.reads().contains(static_cast<Register>(r), static_cast<int>(c)) ||
                            (!program.keeps_registers() && samples.after[r][c].first != nullptr);
        if (!needed) continue;
        const InputArray& from = samples.input[r][c];
        s9* const plane = registers.plane[r][c].data();
        if (from.first != nullptr && from.stride != 0) {
          varying[c] = plane;
        } else {
          const auto* const sample = static_cast<const std::byte*>(from.first);
          same_[sames_++] = {plane, sample == nullptr ? samples.otherwise.value[r][c] : sample_at(sample, from.type)};
        }
      }
      if (varying != detail::ComponentPlanes{}) inputs_[varyings_++].emplace(samples.input[r], varying);
    }
  }

  void fill_same(std::size_t count) const {
    for (std::size_t i = 0; i < sames_; ++i) std::fill_n(same_[i].plane, count, same_[i].code);
  }
  void take(std::size_t begin, std::size_t count) const {
    for (std::size_t i = 0; i < varyings_; ++i) inputs_[i]->take(begin, count);
  }

 private:
  struct Same {
    s9* plane;
    s9 code;
  };
  std::array<Same, 4 * kRegisterCount> same_;
  std::array<std::optional<RegisterInput>, kRegisterCount> inputs_;
  std::size_t sames_ = 0, varyings_ = 0;
};

}  // namespace

void FragmentArrays::read_rgba8(Register reg, const std::uint8_t* picture) {
  for (std::size_t c = 0; c < 4; ++c) input[static_cast<std::size_t>(reg)][c] = {picture + c, 4, ElementType::byte};
}

void FragmentArrays::write_rgba8(std::uint8_t* picture) {
  for (std::size_t c = 0; c < 4; ++c) color[c] = {picture + c, 4, ElementType::byte};
}

std::optional<CodeOutOfRange> find_code_out_of_range(const Program& program, const FragmentArrays& samples) {
  const auto lowest = static_cast<s9>(program.datapath.lowest), one = static_cast<s9>(program.datapath.one);
  const auto is_wrong = [&](s9 code) { return code < lowest || code > one; };
  const bool all_bytes_fit = !is_wrong(255);
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      const InputArray& from = samples.input[r][c];
      if (from.first == nullptr || samples.count == 0) continue;
      if (from.type == ElementType::byte && all_bytes_fit) continue;
      if (are_codes_together(from)) {
        if (detail::all_within(static_cast<const s9*>(from.first), samples.count, lowest, one)) continue;
      }
      alignas(64) std::array<s9, kBatchSize> copy;
      const std::size_t count = from.stride == 0 ? 1 : samples.count;
      for (std::size_t begin = 0; begin < count; begin += kBatchSize) {
        const std::size_t here = std::min(kBatchSize, count - begin);
        load(from, begin, here, copy.data());
        if (detail::all_within(copy.data(), here, lowest, one)) continue;
        const s9 code = *std::find_if(copy.begin(), copy.begin() + here, is_wrong);
        return CodeOutOfRange{static_cast<Register>(r), static_cast<int>(c), code};
      }
    }
  }
  return std::nullopt;
}

void evaluate(const BatchProgram& program, const FragmentArrays& samples, std::size_t begin, std::size_t end) {
  RegisterBatch registers;
  OutputBatch out;
  const Batches batches(program, samples, registers);
  const std::size_t most = std::min(kBatchSize, end - begin);
  batches.fill_same(most);
  std::array<const s9*, 4> colors{};
  for (std::size_t c = 0; c < 4; ++c) colors[c] = out.plane[c].data();
  for (; begin < end; begin += kBatchSize) {
    const std::size_t count = std::min(kBatchSize, end - begin);
    batches.take(begin, count);
    program.run(registers, count, out);
    store_all(colors, begin, count, samples.color);
    if (program.keeps_registers()) continue;
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      if (!is_wanted(samples.after[r])) continue;
      std::array<const s9*, 4> planes{};
      for (std::size_t c = 0; c < 4; ++c) planes[c] = registers.plane[r][c].data();
      store_all(planes, begin, count, samples.after[r]);
    }
    batches.fill_same(most);
  }
}

}  // namespace ninebit
