#include "src/language/register_log/log_tracker.h"

#include <algorithm>

#include "src/language/xbox/stage_words.h"

namespace ninebit::reglog {
namespace {

using words::bits;
using words::Kind;
using words::Slot;

constexpr std::uint32_t kConstant0 = 1, kConstant1 = 2;  // codes of registers

// Whether one of the four inputs of a word reads the register of a code.
bool input_reads(std::uint32_t word, std::uint32_t code, int inputs = 4) {
  for (int i = 0; i < inputs; ++i) {
    if (bits(word, 24 - 8 * i, 4) == code) return true;
  }
  return false;
}

}  // namespace

LogTracker::LogTracker(ChipClass chip, std::optional<std::uint32_t> frame) : chip_(chip), only_frame_(frame) {
  for (std::uint32_t i = 0; i < methods_.size(); ++i) methods_[i] = method_of(4 * i, chip);
  log_.chip = chip;
}

const Method& LogTracker::method(std::uint32_t number) const {
  static constexpr Method kNone{};
  if (number / 4 >= methods_.size() || number % 4 != 0) return kNone;
  return methods_[number / 4];
}

void LogTracker::set_frame(std::uint32_t frame) {
  frame_ = frame;
  frames_given_ = true;
}

void LogTracker::write(const Method& method, std::optional<std::uint32_t> data, std::uint32_t count,
                       std::uint64_t line) {
  if (overflowed_) return;
  switch (method.kind) {
    case MethodKind::none:
      return;
    case MethodKind::word:
      words_[static_cast<std::size_t>(method.slot.kind)][static_cast<std::size_t>(method.slot.index)] = {
          data.value_or(0), line, !data};
      changed_ = true;
      return;
    case MethodKind::other_word:
      if (data) others_[static_cast<std::size_t>(method.index)] = {*data, line, false};
      changed_ = true;
      return;
    case MethodKind::stage_register:
      if (data) stage_registers_[static_cast<std::size_t>(method.index)] = {*data, line, false};
      changed_ = true;
      return;
    case MethodKind::vertex_format:
      formats_[static_cast<std::size_t>(method.index)] = data;
      return;
    case MethodKind::begin_end:
      // Without data it is unknown whether something begins.
      if (!data) return;
      if (drawing_) end(*data == 0);
      if (*data != 0) begin(*data, line);
      return;
    case MethodKind::clear:
      drawn_in_frame_ = true;
      return;
    case MethodKind::flip:
      if (drawing_) end(false);
      if (drawn_in_frame_ && !frames_given_) ++frame_;
      drawn_in_frame_ = false;
      return;
    default:
      if (drawing_) add_vertices(method, data.value_or(0), count);
  }
}

void LogTracker::begin(std::uint32_t primitive, std::uint64_t line) {
  setup_ = current_setup();
  if (overflowed_) return;
  drawing_ = true;
  drawn_in_frame_ = true;
  draw_line_ = line;
  vertices_ = inline_words_ = 0;
  shows_vertices_ = false;
  kept_.reset();
  log_.frames = std::max(log_.frames, frame_);
  if (only_frame_ && *only_frame_ != frame_) return;
  ++log_.draws;
  LogSetup& setup = log_.setups[setup_];
  if (setup.draws++ == 0) {
    setup.first_line = line;
    setup.first_frame = frame_;
  }
  setup.last_frame = std::max(setup.last_frame, frame_);
  const auto differ = [](const std::vector<RegisterWord>& now, const std::vector<RegisterWord>& before) {
    return !std::equal(now.begin(), now.end(), before.begin(), before.end(),
                       [](const RegisterWord& a, const RegisterWord& b) { return a.value == b.value; });
  };
  setup.other_words_change = setup.other_words_change || differ(other_words(), setup.other_words) ||
                             differ(stage_registers(), setup.stage_registers);
  if (kept_draws_ == kMaxLogDraws) {
    ++unkept_draws_;
    return;
  }
  ++kept_draws_;
  kept_ = setup.draw_calls.size();
  setup.draw_calls.push_back({line, frame_, primitive, {}});
}

void LogTracker::end(bool ended) {
  drawing_ = false;
  if (!ended && unended_line_ == 0) unended_line_ = draw_line_;
  if (kept_) log_.setups[setup_].draw_calls[*kept_].vertices = vertices();
}

void LogTracker::add_vertices(const Method& method, std::uint32_t data, std::uint32_t count) {
  shows_vertices_ = true;
  switch (method.kind) {
    case MethodKind::arrays:
      vertices_ += std::uint64_t{count} * (bits(data, 24, 8) + 1);
      return;
    case MethodKind::elements16:
      vertices_ += std::uint64_t{count} * 2;
      return;
    case MethodKind::elements32:
    case MethodKind::vertex:
      vertices_ += count;
      return;
    case MethodKind::inline_data:
      inline_words_ += count;
      return;
    default:
      return;
  }
}

// Inline data are as many vertices as the formats of the attributes make of them.
std::optional<std::uint64_t> LogTracker::vertices() const {
  if (!shows_vertices_) return std::nullopt;
  if (inline_words_ == 0) return vertices_;
  std::uint64_t size = 0;
  for (const std::optional<std::uint32_t>& format : formats_) {
    if (!format) continue;
    const auto [bytes, alignment] = size_of_attribute(*format);
    if (bytes > 0) size = (size + alignment - 1) / alignment * alignment + bytes;
  }
  if (size == 0 || inline_words_ * 4 % size != 0) return std::nullopt;
  return vertices_ + inline_words_ * 4 / size;
}

int LogTracker::stages() const {
  if (chip_ == ChipClass::nv10) {
    const std::uint32_t count = bits(at(Kind::out_rgb, 1).value, words::kNv10CountShift, 2);
    return count == 1 ? 1 : 2;
  }
  const std::uint32_t count = bits(at(Kind::enable).value, words::kNv20CountShift, 4);
  return count >= 1 && count <= 8 ? static_cast<int>(count) : 8;
}

bool LogTracker::stage_reads(int stage, std::uint32_t code) const {
  return input_reads(at(Kind::in_rgb, stage).value, code) || input_reads(at(Kind::in_alpha, stage).value, code);
}

bool LogTracker::final_reads(std::uint32_t code) const {
  return input_reads(at(Kind::final0).value, code) || input_reads(at(Kind::final1).value, code, 3);
}

bool LogTracker::has_mux() const {
  for (int i = 0; i < stages(); ++i) {
    for (const Kind kind : {Kind::out_rgb, Kind::out_alpha}) {
      const std::uint32_t word = at(kind, i).value;
      if (bits(word, words::kMuxBit, 1) != 0 && bits(word, words::kSumShift, 4) != 0) return true;
    }
  }
  return false;
}

std::vector<Slot> LogTracker::used_words() const {
  const bool nv10 = chip_ == ChipClass::nv10;
  std::vector<Slot> used;
  bool reads[2] = {final_reads(kConstant0), final_reads(kConstant1)};
  const bool unique[2] = {bits(at(Kind::enable).value, words::kNv20Unique0Bit, 1) != 0,
                          bits(at(Kind::enable).value, words::kNv20Unique1Bit, 1) != 0};
  bool shared[2] = {false, false};
  for (int i = 0; i < stages(); ++i) {
    for (const Kind kind : {Kind::in_alpha, Kind::in_rgb, Kind::out_alpha, Kind::out_rgb}) used.push_back({kind, i});
    for (int k = 0; k < 2; ++k) {
      if (!stage_reads(i, k == 0 ? kConstant0 : kConstant1)) continue;
      if (nv10) {
        reads[k] = true;
      } else if (unique[k]) {
        used.push_back({k == 0 ? Kind::stage_color0 : Kind::stage_color1, i});
      } else {
        shared[k] = true;
      }
    }
  }
  // NV10 counts its stages in the second one's word.
  if (nv10 && stages() == 1) used.push_back({Kind::out_rgb, 1});
  for (int k = 0; k < 2; ++k) {
    if (shared[k]) used.push_back({k == 0 ? Kind::stage_color0 : Kind::stage_color1, 0});
    if (reads[k]) used.push_back({Kind::color, k});
  }
  used.push_back({Kind::final0, 0});
  used.push_back({Kind::final1, 0});
  if (!nv10) used.push_back({Kind::enable, 0});
  return used;
}

// The value of a word without bits that have no effect.
std::uint32_t LogTracker::normalized(Slot slot) const {
  std::uint32_t value = at(slot.kind, slot.index).value;
  const bool nv10_control = chip_ == ChipClass::nv10 && slot.kind == Kind::out_rgb && slot.index == 1;
  if (nv10_control) {
    if (stages() == 1) value &= 3U << words::kNv10CountShift | 1U << words::kNv10MuxMsbBit;
    if (!has_mux()) value |= 1U << words::kNv10MuxMsbBit;
  }
  if (slot.kind == Kind::enable) {
    if (!has_mux()) value |= 1U << words::kNv20MuxMsbBit;
    const std::pair<std::uint32_t, int> flags[] = {{kConstant0, words::kNv20Unique0Bit},
                                                   {kConstant1, words::kNv20Unique1Bit}};
    for (const auto& [code, bit] : flags) {
      bool read = false;
      for (int i = 0; i < stages(); ++i) read = read || stage_reads(i, code);
      if (!read) value &= ~(1U << bit);
    }
  }
  return value;
}

std::size_t LogTracker::current_setup() {
  if (!changed_) return last_setup_;
  changed_ = false;
  const std::vector<Slot> used = used_words();
  std::string key;
  for (const Slot& slot : used) {
    key += static_cast<char>(slot.kind);
    key += static_cast<char>(slot.index | (at(slot.kind, slot.index).unknown ? 0x80 : 0));
    const std::uint32_t value = normalized(slot);
    for (int i = 0; i < 32; i += 8) key += static_cast<char>(bits(value, i, 8));
  }
  key += stage_key();
  const auto [found, is_new] = by_words_.try_emplace(std::move(key), log_.setups.size());
  last_setup_ = found->second;
  if (!is_new) return last_setup_;
  if (log_.setups.size() == kMaxLogSetups) {
    overflowed_ = true;
    return last_setup_;
  }
  log_.setups.push_back(new_setup(used));
  return last_setup_;
}

LogSetup LogTracker::new_setup(const std::vector<Slot>& used) const {
  LogSetup setup;
  for (const Slot& slot : used) {
    const Word& word = at(slot.kind, slot.index);
    constexpr std::uint64_t kMostLines = 0x7fffffff;
    const auto line = static_cast<int>(std::min(std::max<std::uint64_t>(word.line, 1), kMostLines));
    setup.words.push_back({words::canonical_name(slot, chip_), normalized(slot), {line, 1}});
    if (word.line == 0) setup.unwritten.push_back(setup.words.back().name);
    if (word.unknown) setup.unknown.push_back(setup.words.back().name);
  }
  setup.other_words = other_words();
  setup.stage_registers = stage_registers();
  return setup;
}

std::vector<RegisterWord> LogTracker::other_words() const {
  std::vector<RegisterWord> found;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (others_[i].line != 0) found.push_back({std::string(kOtherWordNames[i]), others_[i].value, {}});
  }
  return found;
}

std::string LogTracker::stage_key() const {
  std::vector<RegisterWord> all = other_words(), found = stage_registers();
  all.insert(all.end(), found.begin(), found.end());
  const xbox::StageWords stages = xbox::decode_stage_words(all);
  if (stages.why.empty()) {
    const TextureShaderState used = only_used(stages.state);
    if (only_reads_textures(used)) return "";
    if (const auto encoded = xbox::encode_stage_words(used)) all = *encoded;
    const std::vector<RegisterWord> numbers = xbox::encode_stage_numbers(used);
    all.insert(all.end(), numbers.begin(), numbers.end());
  }
  std::string key;
  for (const RegisterWord& word : all) key += word.name + '=' + std::to_string(word.value) + ';';
  return key;
}

// CONTROL0 also switches stencil and depth: only its conversion of colours counts.
std::vector<RegisterWord> LogTracker::stage_registers() const {
  std::vector<RegisterWord> found;
  for (std::size_t i = 0; i < stage_registers_.size(); ++i) {
    const bool is_control = i + 1 == stage_registers_.size();
    const std::uint32_t value = stage_registers_[i].value & (is_control ? 0xf0000000 : 0xffffffff);
    if (stage_registers_[i].line != 0) found.push_back({stage_register_name(i), value, {}});
  }
  return found;
}

RegisterLog LogTracker::finish() {
  if (drawing_) end(false);
  // Part of a trace may have no draw; then its last words are what it shows.
  if (log_.setups.empty() && !overflowed_) (void)current_setup();
  return std::move(log_);
}

}  // namespace ninebit::reglog
