#include "src/language/xbox/xbox_numbers.h"

#include <algorithm>
#include <charconv>

#include "src/language/source/source_faults.h"
#include "src/language/xbox/xbox_dump_line.h"

namespace ninebit::xbox {
namespace {

// A D3DPIXELSHADERDEF_FILE of the Xbox's development kit begins with it.
constexpr std::string_view kFileMagic = "PSB0";

std::uint32_t value_of(std::string_view digits) {
  std::uint32_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return value;
}

// How the numbers of a list are written.
struct Style {
  explicit Style(const DumpNumbers& dump) {
    const std::vector<DumpNumber>& numbers = dump.numbers;
    prefixed = std::any_of(numbers.begin(), numbers.end(), [](const DumpNumber& number) { return number.prefixed; });
    if (!prefixed && !numbers.empty()) digits = numbers.front().digits.size();
    // As xxd -i writes what it reads from a pipe.
    const bool bytes = numbers.size() == kXboxDefinitionBytes &&
                       std::all_of(numbers.begin(), numbers.end(), [](const DumpNumber& number) {
                         return number.prefixed && number.digits.size() == 2;
                       });
    if (prefixed) {
      unit = bytes ? 1 : 4;
    } else if (digits == 8 || (digits == 4 && dump.little_endian_halves)) {
      unit = digits / 2;
    }
  }

  [[nodiscard]] bool fits(const DumpNumber& number) const {
    const std::size_t found = number.digits.size();
    if (!is_hex_number(number)) return false;
    if (prefixed) return found <= 8 && (number.prefixed || number.digits == "0");
    return digits > 8 ? found % 2 == 0 : found == digits;
  }
  [[nodiscard]] std::string expected() const {
    if (prefixed) return "0x and up to 8 hexadecimal digits";
    return digits > 8 ? "an even number of hexadecimal digits" : std::to_string(digits) + " hexadecimal digits";
  }

  bool prefixed = false;  // with 0x; a 0 may stand alone
  std::size_t digits = 8;
  std::size_t unit = 1;  // the bytes of a number in little endian: 1, 2 or 4; longer ones are bytes in their order
};

}  // namespace

void check_count(std::size_t found, std::string_view what, std::size_t expected, TextPlace place, TextFaults& faults) {
  if (found == expected) return;
  const std::string count = found > kMostNumbers ? "more than " + std::to_string(kMostNumbers) : std::to_string(found);
  faults.add(place, count + " " + std::string(what) + "; expected the " + std::to_string(expected) +
                        " of a D3DPIXELSHADERDEF");
}

bool is_binary(std::string_view bytes) {
  return bytes.find('\0') != std::string_view::npos;
}

bool is_definition_file(std::string_view bytes) {
  return bytes.starts_with(kFileMagic);
}

Definition read_bytes(std::string_view bytes, TextFaults& faults) {
  Definition definition;
  if (is_definition_file(bytes)) {
    const std::size_t expected = kFileMagic.size() + kXboxDefinitionBytes;
    if (bytes.size() != expected) {
      faults.add({}, "a file 'PSB0' of " + std::to_string(bytes.size()) + " bytes; expected " +
                         std::to_string(expected) + ", the magic and one D3DPIXELSHADERDEF");
      return definition;
    }
    bytes.remove_prefix(kFileMagic.size());
  }
  if (bytes.size() != kXboxDefinitionBytes) {
    const bool several = !bytes.empty() && bytes.size() % kXboxDefinitionBytes == 0;
    faults.add({}, std::to_string(bytes.size()) + " bytes" +
                       (several ? ", which are " + std::to_string(bytes.size() / kXboxDefinitionBytes) + " definitions"
                                : std::string()) +
                       "; expected the 240 of one D3DPIXELSHADERDEF");
    return definition;
  }
  for (std::size_t i = 0; i < kXboxDefinitionWords; ++i) {
    definition.places[i] = place_of(bytes, 4 * i);
    for (std::size_t k = 0; k < 4; ++k) {
      definition.words[i] |= std::uint32_t{static_cast<unsigned char>(bytes[4 * i + k])} << (8 * k);
    }
  }
  return definition;
}

Definition read_number_list(std::string_view text, TextFaults& faults) {
  Definition definition;
  const DumpNumbers dump = read_dump(text, faults);
  const bool complete = faults.empty();
  const Style style(dump);
  std::size_t bytes = 0;
  TextPlace last;
  for (const DumpNumber& number : dump.numbers) {
    last = number.place;
    if (!style.fits(number)) {
      faults.add(number.place,
                 detail::quoted(number.digits) + " is not a number of this list; expected " + style.expected());
      bytes += style.prefixed ? style.unit : style.digits / 2;
      continue;
    }
    const std::size_t step = style.prefixed ? number.digits.size() : 2 * style.unit;
    for (std::size_t at = 0; at < number.digits.size(); at += step, bytes += style.unit) {
      if (bytes >= kXboxDefinitionBytes) continue;
      std::optional<TextPlace>& place = definition.places[bytes / 4];
      if (!place) place = number.place;
      definition.words[bytes / 4] |= value_of(number.digits.substr(at, step)) << (8 * (bytes % 4));
    }
  }
  if (complete && style.unit == 4) {
    check_count(bytes / 4, "words of 32 bits", kXboxDefinitionWords, last, faults);
  } else if (complete) {
    check_count(bytes, "bytes", kXboxDefinitionBytes, last, faults);
  }
  return definition;
}

}  // namespace ninebit::xbox
