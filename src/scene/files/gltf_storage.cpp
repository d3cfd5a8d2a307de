#include "src/scene/files/gltf_storage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <system_error>

#include "src/scene/files/scene_readers.h"
#include "src/scene/files/text_scan.h"
#include "src/scene/scene_check.h"

namespace ninebit {

std::uint64_t gltf_component_size(std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

namespace {

std::string numbered(const char* what, std::size_t number) {
  return fmt::format("{} {}", what, number);
}

std::uint64_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4" || type == "MAT2") return 4;
  if (type == "MAT3") return 9;
  return type == "MAT4" ? 16 : 0;
}

std::uint64_t element_size(const JsonValue& accessor) {
  return gltf_component_size(index_of(item(accessor, "componentType")).value_or(0)) *
         component_count(text_of(item(accessor, "type")));
}

// 0 if a part has no offset, and past every end if its offset is not a valid index.
std::uint64_t offset_of(const JsonValue& part) {
  const JsonValue& offset = item(part, "byteOffset");
  return offset.is_null() ? 0 : index_of(offset).value_or(1ULL << 53U);
}

// The bytes from one element to the next. Without a stride, or with 0, the elements are packed.
std::uint64_t stride_of(const JsonValue& view, std::uint64_t element) {
  const std::uint64_t stride = index_of(item(view, "byteStride")).value_or(0);
  return stride == 0 ? element : stride;
}

std::optional<Diagnostic> check_view(const JsonValue& root, const JsonValue& view, std::size_t number) {
  const JsonValue& buffer = target_of(item(root, "buffers"), item(view, "buffer"));
  const std::optional<std::uint64_t> length = index_of(item(view, "byteLength"));
  if (buffer.is_null() || !length)
    return fault_of(fmt::format("{} has no buffer or no length", numbered("buffer view", number)));
  if (offset_of(view) + *length > index_of(item(buffer, "byteLength")).value_or(0))
    return fault_of(fmt::format("{} reaches past the end of its buffer", numbered("buffer view", number)));
  return std::nullopt;
}

std::optional<Diagnostic> check_accessor(const JsonValue& root, const JsonValue& accessor, std::size_t number) {
  const std::string name = numbered("accessor", number);
  const std::uint64_t element = element_size(accessor);
  const std::optional<std::uint64_t> count = index_of(item(accessor, "count"));
  if (element == 0 || !count || *count == 0) return fault_of(fmt::format("{} has no valid type or count", name));
  if (!item(accessor, "sparse").is_null())
    return fault_of(fmt::format("{} is sparse; such accessors are not read", name));
  if (item(accessor, "bufferView").is_null()) return std::nullopt;
  const JsonValue& view = target_of(item(root, "bufferViews"), item(accessor, "bufferView"));
  if (view.is_null()) return fault_of(fmt::format("{} names a buffer view that does not exist", name));
  const std::uint64_t stride = stride_of(view, element);
  if (stride < element)
    return fault_of(
        fmt::format("{} has elements of {} bytes, but its buffer view has a stride of {} bytes; expected "
                    "elements that do not overlap",
                    name, element, stride));
  const std::uint64_t length = index_of(item(view, "byteLength")).value_or(0);
  if (stride > 252 || *count > length || offset_of(accessor) + (*count - 1) * stride + element > length)
    return fault_of(fmt::format("{} reaches past the end of its buffer view", name));
  return std::nullopt;
}

std::string_view base64_of(const std::string& uri) {
  const std::size_t data = uri.find(";base64,");
  return data == std::string::npos ? std::string_view() : std::string_view(uri).substr(data + 8);
}

}  // namespace

std::uint32_t GltfNumbers::index(std::uint64_t at) const {
  return little_endian(data, at * stride, gltf_component_size(component));
}

float GltfNumbers::component_at(std::uint64_t at, std::uint64_t i) const {
  const std::uint64_t size = gltf_component_size(component);
  const std::uint32_t bits = little_endian(data, at * stride + i * size, size);
  switch (component) {
    case 5120:
      return std::max(static_cast<float>(static_cast<std::int8_t>(bits)) / 127.0F, -1.0F);
    case 5121:
      return static_cast<float>(bits) / 255.0F;
    case 5122:
      return std::max(static_cast<float>(static_cast<std::int16_t>(bits)) / 32767.0F, -1.0F);
    case 5123:
      return static_cast<float>(bits) / 65535.0F;
    default:
      return std::bit_cast<float>(bits);
  }
}

std::optional<std::string> fault_of_use(const JsonValue& accessor, const char* type,
                                        std::initializer_list<std::uint64_t> components) {
  if (accessor.is_null()) return "names an accessor that does not exist";
  const std::uint64_t component = index_of(item(accessor, "componentType")).value_or(0);
  if (text_of(item(accessor, "type")) != type ||
      std::find(components.begin(), components.end(), component) == components.end())
    return "uses an accessor of the wrong type";
  return std::nullopt;
}

GltfStorage::GltfStorage(const JsonValue& root, const NamedFiles& beside, std::optional<std::string_view> chunk)
    : root_(root), beside_(beside), chunk_(chunk), left_(kMostSceneBytes) {}

std::optional<Diagnostic> GltfStorage::check() {
  const JsonValue& buffers = list_of(item(root_, "buffers"));
  const JsonValue& views = list_of(item(root_, "bufferViews"));
  const JsonValue& accessors = list_of(item(root_, "accessors"));
  if (buffers.size() > kMostBuffers)
    return fault_of(fmt::format("has {} buffers; at most {} are read", buffers.size(), kMostBuffers));
  loaded_.assign(buffers.size(), std::nullopt);
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (auto fault = check_buffer(buffers[i], i)) return fault;
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (auto fault = check_view(root_, views[i], i)) return fault;
  }
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    if (auto fault = check_accessor(root_, accessors[i], i)) return fault;
  }
  return std::nullopt;
}

std::optional<Diagnostic> GltfStorage::check_buffer(const JsonValue& buffer, std::size_t number) {
  const std::optional<std::uint64_t> declared = index_of(item(buffer, "byteLength"));
  if (!declared) return fault_of(fmt::format("{} has no length", numbered("buffer", number)));
  if (*declared > kMostSceneBytes)
    return fault_of(fmt::format("{} declares {} bytes; at most {} are read", numbered("buffer", number), *declared,
                                kMostSceneBytes));
  const Result<std::uint64_t> present = present_bytes(buffer, number);
  if (!present) return present.error();
  if (*present < *declared)
    return fault_of(
        fmt::format("{} ends early: it declares {} bytes and has {}", numbered("buffer", number), *declared, *present));
  bytes_ += *declared;
  return std::nullopt;
}

Result<std::uint64_t> GltfStorage::present_bytes(const JsonValue& buffer, std::size_t number) const {
  const std::string& uri = text_of(item(buffer, "uri"));
  if (uri.empty()) {
    if (number != 0 || !chunk_)
      return fault_of(fmt::format("{} has neither a URI nor a chunk", numbered("buffer", number)));
    return std::uint64_t{chunk_->size()};
  }
  if (uri.starts_with("data:")) {
    if (uri.find(";base64,") == std::string::npos)
      return fault_of(fmt::format("{} is not in base64", numbered("buffer", number)));
    const std::optional<std::string> content = decode_base64(base64_of(uri));
    if (!content)
      return fault_of(
          fmt::format("{} holds characters that are not base64, or has no '=' padding", numbered("buffer", number)));
    return std::uint64_t{content->size()};
  }
  const std::string name = decode_percent(uri);
  if (const Status allowed = beside_.check(name); !allowed) return allowed.error();
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(beside_.path_of(name), error);
  if (error) return fault_of(fmt::format("its buffer file '{}' cannot be opened: {}", name, error.message()));
  return std::uint64_t{size};
}

Result<std::string_view> GltfStorage::load(std::size_t number) {
  if (loaded_[number]) return *loaded_[number];
  const JsonValue& buffer = item(root_, "buffers", number);
  const std::string& uri = text_of(item(buffer, "uri"));
  std::string_view content;
  if (uri.empty()) {
    content = chunk_.value_or("");
  } else if (uri.starts_with("data:")) {
    content = contents_.emplace_back(decode_base64(base64_of(uri)).value_or(""));
  } else {
    const std::string name = decode_percent(uri);
    const auto [file, added] = from_files_.try_emplace(beside_.path_of(name));
    if (added) {
      Result<std::string> read = beside_.read(name, left_);
      if (!read) return fault_of(fmt::format("its buffer file '{}' {}", name, read.error().message));
      left_ -= read->size();
      file->second = contents_.emplace_back(std::move(*read));
    }
    content = file->second;
  }
  // The file may have changed since check().
  const std::uint64_t declared = index_of(item(buffer, "byteLength")).value_or(0);
  if (content.size() < declared) return fault_of(fmt::format("{} ends early", numbered("buffer", number)));
  loaded_[number] = content.substr(0, declared);
  return *loaded_[number];
}

Result<std::string_view> GltfStorage::view_bytes(const JsonValue& view) {
  const Result<std::string_view> buffer = load(index_of(item(view, "buffer")).value_or(0));
  if (!buffer) return buffer.error();
  return buffer->substr(offset_of(view), index_of(item(view, "byteLength")).value_or(0));
}

Result<GltfNumbers> GltfStorage::numbers(const JsonValue& accessor) {
  const JsonValue& view = target_of(item(root_, "bufferViews"), item(accessor, "bufferView"));
  const Result<std::string_view> buffer = load(index_of(item(view, "buffer")).value_or(0));
  if (!buffer) return buffer.error();
  GltfNumbers out;
  out.data = buffer->substr(offset_of(view)).substr(offset_of(accessor));
  out.count = index_of(item(accessor, "count")).value_or(0);
  out.stride = stride_of(view, element_size(accessor));
  out.component = index_of(item(accessor, "componentType")).value_or(0);
  return out;
}

namespace {

std::uint64_t little32(std::string_view data, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8U) | static_cast<unsigned char>(data[at + i]);
  return value;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

Result<GlbParts> split_glb1(std::string_view content) {
  const std::uint64_t size = little32(content, 12);
  if (little32(content, 16) != 0) return fault_of("is malformed: the first part of a .glb file of version 1 is JSON");
  if (size > content.size() - 20) return fault_of("is malformed: its JSON is longer than the file");
  return GlbParts{content.substr(20, size), content.substr(20 + size)};
}

}  // namespace

Result<GlbParts> split_glb(std::string_view content) {
  constexpr std::uint64_t kJson = 0x4E4F534A;
  constexpr std::uint64_t kBinary = 0x004E4942;
  if (content.substr(0, 4) != "glTF") return fault_of("is not a binary glTF file: it does not start with 'glTF'");
  if (content.size() < 20) return fault_of("ends early, within its header");
  const std::uint64_t version = little32(content, 4);
  if (version != 1 && version != 2)
    return fault_of(fmt::format("is of binary glTF version {}; versions 1 and 2 are read", version));
  const std::uint64_t length = little32(content, 8);
  if (length > content.size())
    return fault_of(fmt::format("ends early: it declares {} bytes and has {}", length, content.size()));
  if (version == 1) return split_glb1(content);
  GlbParts parts;
  std::string_view rest = content.substr(12, length < 12 ? 0 : length - 12);
  for (bool first = true; rest.size() >= 8; first = false) {
    const std::uint64_t size = little32(rest, 0);
    const std::uint64_t type = little32(rest, 4);
    if (size > rest.size() - 8) return fault_of("is malformed: a chunk is longer than the file");
    if (first && type != kJson) return fault_of("is malformed: its first chunk is not JSON");
    if (first) parts.json = rest.substr(8, size);
    if (!first && type == kBinary && !parts.binary) parts.binary = rest.substr(8, size);
    rest.remove_prefix(8 + size);
  }
  return parts;
}

std::optional<std::string> decode_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  // One or two '=' pad the last group of four.
  std::size_t digits = text.size();
  while (digits > 0 && text.size() - digits < 2 && text[digits - 1] == '=') --digits;
  std::string out;
  out.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    const int digit = base64_digit(text[i]);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
    // After 1, 2, 3 and 4 digits of a group there are 0, 1, 2 and 3 whole bytes.
    if (i % 4 != 0) out.push_back(static_cast<char>((bits >> (2 * (3 - i % 4))) & 255U));
  }
  return out;
}

std::string decode_percent(std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
      out.push_back(static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])));
      i += 2;
    } else {
      out.push_back(uri[i]);
    }
  }
  return out;
}

}  // namespace ninebit
