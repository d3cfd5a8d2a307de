#include "src/language/register_log/log_methods.h"

#include <algorithm>
#include <string>

#include "src/language/register_log/log_layout.h"
#include "src/system/find_row.h"

namespace ninebit::reglog {
namespace {

using words::Kind;

// A row of words: the first number and how many follow, each 4 more.
struct WordRow {
  std::uint32_t number;
  Kind kind;
};
constexpr WordRow kNv20Rows[] = {
    {0x0260, Kind::in_alpha},     {0x0ac0, Kind::in_rgb},       {0x0aa0, Kind::out_alpha}, {0x1e40, Kind::out_rgb},
    {0x0a60, Kind::stage_color0}, {0x0a80, Kind::stage_color1}, {0x1e20, Kind::color},     {0x0288, Kind::final0},
    {0x028c, Kind::final1},       {0x1e60, Kind::enable},
};
constexpr WordRow kNv10Rows[] = {
    {0x0260, Kind::in_alpha}, {0x0268, Kind::in_rgb}, {0x0278, Kind::out_alpha}, {0x0280, Kind::out_rgb},
    {0x0270, Kind::color},    {0x0288, Kind::final0}, {0x028c, Kind::final1},
};

struct OtherMethod {
  std::uint32_t number;
  MethodKind kind;
  int index = 0;
};
constexpr OtherMethod kNv20Methods[] = {
    {0x012c, MethodKind::flip},
    {0x0130, MethodKind::flip},
    {0x1d94, MethodKind::clear},
    {0x17f8, MethodKind::other_word, 0},
    {0x1e70, MethodKind::other_word, 1},
    {0x1e74, MethodKind::other_word, 2},
    {0x1e78, MethodKind::other_word, 3},
    {0x17fc, MethodKind::begin_end},
    {0x1800, MethodKind::elements16},
    {0x1808, MethodKind::elements32},
    {0x1810, MethodKind::arrays},
    {0x1818, MethodKind::inline_data},
    // The last words of a position: as 3 and 4 floats, as shorts, and of attribute 0.
    {0x1508, MethodKind::vertex},
    {0x1524, MethodKind::vertex},
    {0x152c, MethodKind::vertex},
    {0x1884, MethodKind::vertex},
    {0x1900, MethodKind::vertex},
    {0x1940, MethodKind::vertex},
    {0x1984, MethodKind::vertex},
    {0x1a0c, MethodKind::vertex},
};
constexpr OtherMethod kNv10Methods[] = {
    {0x012c, MethodKind::flip},      {0x0130, MethodKind::flip},        {0x0dfc, MethodKind::begin_end},
    {0x13fc, MethodKind::begin_end}, {0x0e00, MethodKind::elements16},  {0x1100, MethodKind::elements32},
    {0x1400, MethodKind::arrays},    {0x1800, MethodKind::inline_data}, {0x0c08, MethodKind::vertex},
    {0x0c24, MethodKind::vertex},
};
constexpr std::uint32_t kNv20BumpMatrix = 0x1b28, kNv20TextureStride = 0x40, kNv20EyeVector = 0x181c,
                        kNv20Control0 = 0x0290;

// The place of a method among the stages' registers.
std::optional<int> stage_register(std::uint32_t number) {
  constexpr std::uint32_t kOfStage = 6;
  for (std::uint32_t stage = 1; stage < 4; ++stage) {
    const std::uint32_t first = kNv20BumpMatrix + stage * kNv20TextureStride;
    if (number >= first && number < first + 4 * kOfStage) {
      return static_cast<int>((stage - 1) * kOfStage + (number - first) / 4);
    }
  }
  if (number >= kNv20EyeVector && number < kNv20EyeVector + 12) {
    return static_cast<int>(3 * kOfStage + (number - kNv20EyeVector) / 4);
  }
  return number == kNv20Control0 ? std::optional(static_cast<int>(kStageRegisters) - 1) : std::nullopt;
}

// The method of a name such as "texture_set_bump_env_mat[7]" or "eye_vector[0]", whose index counts words, or stages
// where there is one word of each.
std::optional<std::uint32_t> number_of_stage_register(std::string_view bare) {
  const std::size_t open = std::min(bare.find('['), bare.size());
  const std::string_view name = bare.substr(0, open);
  const auto index = open == bare.size()   ? std::optional<std::uint32_t>(0)
                     : bare.ends_with(']') ? number_in(bare.substr(open + 1, bare.size() - open - 2), true)
                                           : std::nullopt;
  if (!index || *index >= 16) return std::nullopt;
  if (name == "control0" && *index == 0) return kNv20Control0;
  if (name == "eye_vector" && *index < 3) return kNv20EyeVector + 4 * *index;
  if (name == "texture_set_bump_env_mat") return kNv20BumpMatrix + *index / 4 * kNv20TextureStride + *index % 4 * 4;
  if (*index >= 4) return std::nullopt;
  if (name == "texture_set_bump_env_scale") return kNv20BumpMatrix + 16 + *index * kNv20TextureStride;
  if (name == "texture_set_bump_env_offset") return kNv20BumpMatrix + 20 + *index * kNv20TextureStride;
  return std::nullopt;
}

constexpr std::uint32_t kNv20VertexFormat = 0x1760;
constexpr std::uint32_t kNv20Attributes = 16;

// Names of methods that are not words, without prefix and SET_.
struct MethodName {
  std::string_view name;
  std::uint32_t nv20, nv10;  // 0: the chip does not have it
};
constexpr MethodName kMethodNames[] = {
    {"begin_end", 0x17fc, 0x0dfc},          {"vertex_begin_end", 0x17fc, 0x0dfc},
    {"vtxbuf_begin_end", 0, 0x13fc},        {"draw_arrays", 0x1810, 0x1400},
    {"vtxbuf_batch", 0x1810, 0x1400},       {"array_element16", 0x1800, 0x0e00},
    {"vtxbuf_element_u16", 0x1800, 0x0e00}, {"array_element32", 0x1808, 0x1100},
    {"vtxbuf_element_u32", 0x1808, 0x1100}, {"inline_array", 0x1818, 0x1800},
    {"vtxbuf_data", 0x1818, 0x1800},        {"flip_increment_write", 0x012c, 0x012c},
    {"flip_incr_write", 0x012c, 0x012c},    {"flip_stall", 0x0130, 0x0130},
    {"flip_wait", 0x0130, 0x0130},          {"clear_surface", 0x1d94, 0},
    {"clear_buffers", 0x1d94, 0},           {"shader_clip_plane_mode", 0x17f8, 0},
    {"tex_shader_cull_mode", 0x17f8, 0},    {"shader_stage_program", 0x1e70, 0},
    {"tex_shader_op", 0x1e70, 0},           {"dot_rgbmapping", 0x1e74, 0},
    {"tex_shader_dotmapping", 0x1e74, 0},   {"shader_other_stage_input", 0x1e78, 0},
    {"tex_shader_previous", 0x1e78, 0},
};

// "RC_IN_RGB[0x1]" as "RC_IN_RGB[1]".
std::string with_decimal_index(std::string_view name) {
  const std::size_t open = name.find("[0x");
  if (open == std::string_view::npos || !name.ends_with(']')) return std::string(name);
  const std::string_view digits = name.substr(open + 1, name.size() - open - 2);
  const auto index = number_in(digits, true);
  return index ? std::string(name.substr(0, open + 1)) + std::to_string(*index) + ']' : std::string(name);
}

}  // namespace

Method method_of(std::uint32_t number, ChipClass chip) {
  const bool nv10 = chip == ChipClass::nv10;
  const std::span<const WordRow> rows = nv10 ? std::span<const WordRow>(kNv10Rows) : kNv20Rows;
  if (number % 4 != 0) return {};
  for (const WordRow& row : rows) {
    const auto count = static_cast<std::uint32_t>(words::count_of(row.kind, chip));
    if (number >= row.number && number < row.number + 4 * count) {
      return {MethodKind::word, {row.kind, static_cast<int>(number - row.number) / 4}, 0};
    }
  }
  if (!nv10 && number >= kNv20VertexFormat && number < kNv20VertexFormat + 4 * kNv20Attributes) {
    return {MethodKind::vertex_format, {}, static_cast<int>(number - kNv20VertexFormat) / 4};
  }
  if (const auto index = nv10 ? std::nullopt : stage_register(number)) return {MethodKind::stage_register, {}, *index};
  const std::span<const OtherMethod> others = nv10 ? std::span<const OtherMethod>(kNv10Methods) : kNv20Methods;
  const OtherMethod* const found = find_row(others, &OtherMethod::number, number);
  return found == nullptr ? Method{} : Method{found->kind, {}, found->index};
}

std::optional<std::uint32_t> number_of(std::string_view name, ChipClass chip) {
  constexpr std::size_t kLongest = 80;
  if (name.size() > kLongest) return std::nullopt;
  const bool nv10 = chip == ChipClass::nv10;
  const std::string plain = with_decimal_index(name);
  if (const words::FoundSlot found = words::find_slot(plain, chip); found.slot) {
    for (const WordRow& row : nv10 ? std::span<const WordRow>(kNv10Rows) : kNv20Rows) {
      if (row.kind == found.slot->kind) return row.number + 4 * static_cast<std::uint32_t>(found.slot->index);
    }
  }
  std::string bare = words::bare_name(plain);
  if (const auto found = nv10 ? std::nullopt : number_of_stage_register(bare)) return found;
  // Tracers also number what is only one.
  if (bare.ends_with("[0]")) bare.resize(bare.size() - 3);
  for (const MethodName& method : kMethodNames) {
    const std::uint32_t number = nv10 ? method.nv10 : method.nv20;
    if (number != 0 && method.name == bare) return number;
  }
  return std::nullopt;
}

std::string stage_register_name(std::size_t index) {
  if (index + 1 == kStageRegisters) return "CONTROL0";
  if (index >= 18) return "EYE_VECTOR[" + std::to_string(index - 18) + ']';
  const std::string stage = '[' + std::to_string(index / 6 + 1) + ']';
  if (index % 6 < 4) return "BUMP_ENV_MAT" + stage + '[' + std::to_string(index % 6) + ']';
  return (index % 6 == 4 ? "BUMP_ENV_SCALE" : "BUMP_ENV_OFFSET") + stage;
}

std::optional<ChipClass> chip_of_class(std::uint32_t object_class) {
  switch (object_class) {
    case 0x97:
    case 0x597:
      return ChipClass::nv20;
    case 0x56:
    case 0x96:
    case 0x98:
    case 0x99:
      return ChipClass::nv10;
    default:
      return std::nullopt;
  }
}

// Types and sizes: nxdk's nv2a_regs.h; that attributes are aligned to their components: xemu, pgraph.c.
AttributeSize size_of_attribute(std::uint32_t format) {
  const std::uint32_t type = words::bits(format, 0, 4), count = words::bits(format, 4, 4);
  constexpr std::uint32_t kBytes[] = {1, 2, 4, 0, 1, 2, 4};  // bytes, shorts, floats, -, bytes, shorts, packed normals
  if (count == 0 || type >= std::size(kBytes) || kBytes[type] == 0) return {};
  return {kBytes[type] * count, kBytes[type]};
}

}  // namespace ninebit::reglog
