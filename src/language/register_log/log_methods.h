// The methods of the chips' 3D objects that matter to a log's reader.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "src/language/register_words/register_words_layout.h"

namespace NINEBIT_PUBLIC ninebit {
namespace reglog {

enum class MethodKind : std::uint8_t {
  none,            // anything else
  word,            // a word of the combiners
  other_word,      // a word of kOtherWordNames
  stage_register,  // a register of texture-shader stages beside these words
  begin_end,       // begins a draw by its primitive, or ends it by 0
  arrays,          // draws a run of the arrays: its length less one in bits 31..24
  elements16,      // two indices
  elements32,      // one index
  inline_data,     // a word of a vertex
  vertex_format,   // how a vertex attribute is stored
  vertex,          // the last part of a position, which completes a vertex
  clear,           // clears the target
  flip             // ends a frame
};

struct Method {
  MethodKind kind = MethodKind::none;
  words::Slot slot{};  // of a word of the combiners
  int index = 0;       // in kOtherWordNames, of a stage register, or of an attribute
};

// The registers of stages: six for each of the stages 1 to 3, three of the eye vector, and CONTROL0; their names in
// LogSetup::stage_registers.
inline constexpr std::size_t kStageRegisters = 22;
[[nodiscard]] std::string stage_register_name(std::size_t index);

// The methods of these numbers, which are those of nxdk's nv2a_regs.h and of envytools rnndb (nv10_3d.xml,
// nv20_3d.xml).
[[nodiscard]] Method method_of(std::uint32_t number, ChipClass chip);

// The number of a method by its name, such as NV097_SET_COMBINER_COLOR_ICW[1] or VERTEX_BEGIN_END; empty for all names
// that this reader does not need. An index counts elements.
[[nodiscard]] std::optional<std::uint32_t> number_of(std::string_view name, ChipClass chip);

// The chip whose 3D objects have this class: Kelvin (0x97, 0x597) or Celsius (0x56, 0x96, 0x98, 0x99).
[[nodiscard]] std::optional<ChipClass> chip_of_class(std::uint32_t object_class);

// The bytes of one vertex attribute of NV20 in inline data: its size in bytes and the bytes of a component, by its
// format; 0 and 1 if the attribute is off.
struct AttributeSize {
  std::uint32_t bytes = 0, alignment = 1;
};
[[nodiscard]] AttributeSize size_of_attribute(std::uint32_t format);

}  // namespace reglog
}  // namespace ninebit
