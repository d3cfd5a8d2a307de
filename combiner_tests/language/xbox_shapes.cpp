#include "combiner_tests/language/xbox_shapes.h"

#include <cstdio>

#include "combiner_tests/combiner/random_state.h"
#include "ninebit/language/register_words.h"

namespace ninebit::test {
namespace {

// Nested braces, one a member, with comments.
std::string initializer(const Words& words) {
  std::string text = "// a shader\nstatic const D3DPIXELSHADERDEF psd =\n{\n";
  for (const Member& member : kMembers) {
    text += std::string("    ") + (member.count > 1 ? "{ " : "");
    for (std::size_t i = 0; i < member.count; ++i) text += (i > 0 ? ", " : "") + hex(words[member.first + i]);
    text += std::string(member.count > 1 ? " }" : "") + ", /* " + member.name + " */\n";
  }
  return text + "};\n";
}

std::string flat_initializer(const Words& words) {
  std::string text = "X_D3DPIXELSHADERDEF psd={";
  for (const std::uint32_t word : words) text += hex(word, "0x%XUL") + (&word == &words.back() ? "" : ",");
  return text + "}";
}

std::string bare_braces(const Words& words) {
  std::string text = "{\n";
  for (const std::uint32_t word : words) text += std::to_string(word) + ",\n";
  return text + "}\n";
}

// From the last member to the first; elements by number.
std::string designated(const Words& words) {
  std::string text = "struct _D3DPixelShaderDef psd = {\n";
  for (std::size_t m = kMembers.size(); m-- > 0;) {
    const Member& member = kMembers[m];
    if (member.count == 1) {
      text += std::string("  .") + member.name + " = " + hex(words[member.first]) + ",\n";
    } else if (m % 2 == 0) {
      text += std::string("  .") + member.name + " = {";
      for (std::size_t i = member.count; i-- > 0;)
        text += "[" + std::to_string(i) + "] = " + hex(words[member.first + i]) + ", ";
      text += "},\n";
    } else {
      for (std::size_t i = 0; i < member.count; ++i) {
        text +=
            std::string("  .") + member.name + "[" + std::to_string(i) + "] = " + hex(words[member.first + i]) + ",\n";
      }
    }
  }
  return text + "};";
}

std::string assignments(const Words& words, const std::string& object, const std::string& end) {
  std::string text;
  for (const Member& member : kMembers) {
    for (std::size_t i = 0; i < member.count; ++i) {
      text += object + member.name + (member.count > 1 ? "[" + std::to_string(i) + "]" : "") + " = " +
              hex(words[member.first + i]) + end;
    }
  }
  return text;
}

// As Cxbx writes a file, its misspelled first name included.
std::string cxbx_dump(const Words& words) {
  std::string text;
  for (const Member& member : kMembers) {
    const std::string name = member.first == 0 ? "PSAphaInputs" : member.name;
    text += name + (member.count > 1 ? "[8]" : "") + "              =";
    for (std::size_t i = 0; i < member.count; ++i) text += ' ' + hex(words[member.first + i], "0x%.08X");
    text += '\n';
  }
  return text;
}

std::string numbers(const Words& words, const char* format, const std::string& between, std::size_t a_line,
                    const char* offset = nullptr, std::size_t unit = 4) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i % a_line == 0) {
      text += i > 0 ? "\n" : "";
      if (offset != nullptr) text += hex(static_cast<std::uint32_t>(unit * i), offset);
    } else {
      text += between;
    }
    text += hex(words[i], format);
  }
  return text + '\n';
}

char printable_byte(unsigned char byte) {
  return byte >= ' ' && byte <= '~' ? static_cast<char>(byte) : '.';
}

// xxd and hexdump -C write the bytes as characters behind the numbers.
std::string byte_dump(const Words& words, bool xxd) {
  const std::string bytes = as_bytes(words);
  std::string text;
  for (std::size_t start = 0; start < bytes.size(); start += 16) {
    text += hex(static_cast<std::uint32_t>(start), xxd ? "%08x:" : "%08x ");
    std::string shown;
    for (std::size_t i = 0; i < 16; ++i) {
      const auto byte = static_cast<unsigned char>(bytes[start + i]);
      if (xxd ? i % 2 == 0 : i != 8) text += ' ';
      if (!xxd && i == 8) text += "  ";
      text += hex(byte, "%02x");
      shown += printable_byte(byte);
    }
    text += xxd ? "  " + shown + '\n' : "  |" + shown + "|\n";
  }
  return xxd ? text : text + "000000f0\n";
}

std::string plain_bytes(const Words& words, std::size_t a_line, const std::string& between) {
  const std::string bytes = as_bytes(words);
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i > 0) text += i % a_line == 0 ? "\n" : between;
    text += hex(static_cast<unsigned char>(bytes[i]), "%02X");
  }
  return text;
}

// As hexdump and od write rows: '*' for those that are the same as the row above, and the offset of the end.
std::string starred(const Words& words, const char* offset, const char* format, std::size_t unit) {
  const std::string bytes = as_bytes(words);
  std::string text, above;
  bool has_star = false;
  for (std::size_t start = 0; start < bytes.size(); start += 16) {
    std::string row;
    for (std::size_t i = 0; i < 16; i += unit) {
      std::uint32_t value = 0;
      for (std::size_t k = unit; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[start + i + k]);
      row += ' ' + hex(value, format);
    }
    if (row == above) {
      text += has_star ? "" : "*\n";
      has_star = true;
      continue;
    }
    text += hex(static_cast<std::uint32_t>(start), offset) + row + '\n';
    has_star = false;
    above = row;
  }
  return text + hex(static_cast<std::uint32_t>(bytes.size()), offset) + '\n';
}

// WinDbg's db, with a hyphen in the middle and characters, and dc, with addresses of 64 bits.
std::string windbg(const Words& words, bool as_words) {
  constexpr std::uint32_t kAddress = 0x00123450;
  const std::string bytes = as_bytes(words);
  std::string text;
  for (std::size_t start = 0; start < bytes.size(); start += 16) {
    const std::uint32_t address = kAddress + static_cast<std::uint32_t>(start);
    text += (as_words ? "00007ff6`" : "") + hex(address, "%08x ");
    std::string shown;
    for (std::size_t i = 0; i < 16; ++i) {
      const auto byte = static_cast<unsigned char>(bytes[start + i]);
      if (!as_words) text += (i == 8 ? "-" : " ") + hex(byte, "%02x");
      if (as_words && i % 4 == 0) text += ' ' + hex(words[(start + i) / 4], "%08x");
      shown += printable_byte(byte);
    }
    text += "  " + shown + "\r\n";
  }
  return text;
}

std::string word_array(const Words& words, const std::string& head) {
  std::string text = "#pragma once\n" + head + " = {\n";
  for (const std::uint32_t word : words) text += hex(word, "0x%08x,\n");
  return text + "};\n";
}

std::string byte_array(const Words& words, const std::string& head, const std::string& end) {
  std::string text = head;
  for (const char byte : as_bytes(words)) text += hex(static_cast<unsigned char>(byte), " 0x%02x,");
  text.pop_back();
  return text + end;
}

}  // namespace

std::string hex(std::uint32_t word, const char* format) {
  std::array<char, 32> text{};
  // The formats are those of this file and its tests.
  std::snprintf(text.data(), text.size(), format, word);
  return text.data();
}

Words random_words(Random& random) {
  const CombinerState state = random_state(random, profiles::nv2a);
  const auto encoded = encode_register_words(state, ChipClass::nv20, profiles::nv2a);
  Words words{};
  for (const Member& member : kMembers) {
    for (std::size_t i = 0; i < member.count; ++i) {
      const std::string name = std::string(member.word) + (member.count > 1 ? "[" + std::to_string(i) + "]" : "");
      for (const RegisterWord& word : *encoded) {
        if (word.name == name) words[member.first + i] = word.value;
      }
      if (*member.word == '\0') words[member.first + i] = static_cast<std::uint32_t>(random.next());
    }
  }
  return words;
}

std::string as_register_words(const Words& words) {
  std::string text;
  for (const Member& member : kMembers) {
    if (*member.word == '\0') continue;
    for (std::size_t i = 0; i < member.count; ++i) {
      text += std::string(member.word) + (member.count > 1 ? "[" + std::to_string(i) + "]" : "") + " = " +
              hex(words[member.first + i]) + '\n';
    }
  }
  return text;
}

std::string as_bytes(const Words& words) {
  std::string bytes;
  for (const std::uint32_t word : words) {
    for (int i = 0; i < 32; i += 8) bytes += static_cast<char>(word >> i & 0xff);
  }
  return bytes;
}

std::vector<Shape> all_shapes() {
  return {
      {"initializer", initializer},
      {"flat initializer", flat_initializer},
      {"braces alone", bare_braces},
      {"designated initializer", designated},
      {"members of an object",
       [](const Words& w) { return "ZeroMemory( &psd, sizeof(psd) );\n" + assignments(w, "psd.", ";\n"); }},
      {"members behind a pointer", [](const Words& w) { return assignments(w, "this->m_psd[2].", " ;  // set\n"); }},
      {"assignments without semicolons", [](const Words& w) { return assignments(w, "", "\r\n"); }},
      {"a file of Cxbx", cxbx_dump},
      {"dwords", [](const Words& w) { return numbers(w, "%08x", " ", 8); }},
      {"dwords with 0x, one a line", [](const Words& w) { return numbers(w, "0x%X,", "", 1); }},
      {"dwords with 0x and commas", [](const Words& w) { return numbers(w, "0x%08x", ", ", 4); }},
      {"dwords with 0x and suffixes", [](const Words& w) { return numbers(w, "0x%08xUL", " ", 4); }},
      {"dwords with 0x and small suffixes", [](const Words& w) { return numbers(w, "0x%Xlu", ", ", 4); }},
      {"dwords with offsets", [](const Words& w) { return numbers(w, "%08X", " ", 4, "%04x: "); }},
      {"dwords with offsets without colons", [](const Words& w) { return numbers(w, "%08x", " ", 4, "%08x "); }},
      {"od -t x4", [](const Words& w) { return numbers(w, "%08x", " ", 4, "%07o ") + "0000360\n"; }},
      {"xxd", [](const Words& w) { return byte_dump(w, true); }},
      {"xxd -p", [](const Words& w) { return plain_bytes(w, 30, ""); }},
      {"hexdump -C", [](const Words& w) { return byte_dump(w, false); }},
      {"bytes", [](const Words& w) { return plain_bytes(w, 16, " "); }},
      {"bytes with commas", [](const Words& w) { return plain_bytes(w, 12, ", "); }},
      {"hexdump", [](const Words& w) { return starred(w, "%07x", "%04x", 2); }},
      {"od -t x1", [](const Words& w) { return starred(w, "%07o", "%02x", 1); }},
      {"od -x", [](const Words& w) { return starred(w, "%07o", "%04x", 2); }},
      {"od -A x -t x4", [](const Words& w) { return starred(w, "%06x", "%08x", 4); }},
      {"od -A d -t x4", [](const Words& w) { return starred(w, "%07u", "%08x", 4); }},
      {"hexdump -C without characters", [](const Words& w) { return starred(w, "%08x ", "%02x", 1); }},
      {"WinDbg's db", [](const Words& w) { return windbg(w, false); }},
      {"WinDbg's dc", [](const Words& w) { return windbg(w, true); }},
      {"WinDbg's dd", [](const Words& w) { return numbers(w, "%08x", " ", 4, "%08x  "); }},
      {"an array of DWORD", [](const Words& w) { return word_array(w, "DWORD ps[60]"); }},
      {"an array of unsigned int", [](const Words& w) { return word_array(w, "static const unsigned int ps[]"); }},
      {"an array of uint32_t", [](const Words& w) { return word_array(w, "constexpr std::uint32_t ps[8 * 7 + 4]"); }},
      {"an array of BYTE", [](const Words& w) { return byte_array(w, "const BYTE ps[240] = {", "};"); }},
      {"xxd -i",
       [](const Words& w) {
         return byte_array(w, "unsigned char psd_bin[] = {\n ", "\n};\nunsigned int psd_bin_len = 240;\n");
       }},
      {"xxd -i of a pipe", [](const Words& w) { return byte_array(w, " ", "\n"); }},
      {"bytes in braces", [](const Words& w) { return byte_array(w, "{", "}"); }},
      {"binary", as_bytes},
  };
}

}  // namespace ninebit::test
