// Files that would take more memory than they are worth: refused before the memory is taken, in a line that says why.
// The large ones are sparse, so that no disk holds them. docs/internals/limits.md lists the limits.
#include <gtest/gtest.h>

#include <fstream>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30U;
constexpr std::uint64_t kMiB = std::uint64_t{1} << 20U;
// In the KiB of Outcome::peak_kib.
constexpr long kKiBOfMiB = 1L << 10U;
constexpr long kBase = 48 * kKiBOfMiB;  // what the program takes of itself, and pieces of a file

class Limits : public testing::Test {
 protected:
  // A file of so many bytes that begins with the text; the rest is zeros.
  std::string sparse(const std::string& name, std::string_view text, std::uint64_t size) const {
    std::string file = write_bytes(folder_ / name, text);
    std::filesystem::resize_file(file, size);
    return file;
  }
  // A file of the head, the piece again and again until there are so many bytes, and the tail. The text is never whole
  // in this process: what that holds when it forks counts as the program's.
  std::string repeated(const std::string& name, std::string_view head, std::string_view piece, std::uint64_t size,
                       std::string_view tail) const {
    std::ofstream file(folder_ / name, std::ios::binary);
    file << head;
    for (std::uint64_t written = head.size(); written < size; written += piece.size()) file << piece;
    file << tail;
    return folder_ / name;
  }
  [[nodiscard]] Outcome render(const std::string& scene, const Words& more = {}) const {
    return ninebit(small_render(scene, folder_ / "out", more));
  }
  // Refused, within so many KiB, and without an output folder.
  void expect_refused(const Outcome& outcome, const Words& words, long most_kib) const {
    expect_error(outcome, 3, words);
    EXPECT_TRUE(ninebit::test::kSanitized || outcome.peak_kib < most_kib)
        << outcome.peak_kib << " KiB: " << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
  }

  TempFolder folder_;
};

TEST_F(Limits, AFileThatIsNoSceneTakesAMultipleOfItsSize) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  struct Case {
    const char* name;
    std::string text;
    Words words;
    long times;
  };
  const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n";
  for (const Case& c : std::vector<Case>{
           {"a.obj", "v 0 0 0\n", {"binary data"}, 1},
           {"a.off", "OFF\n3 1 0\n", {"longer than 16777216 bytes"}, 1},
           {"a.ply", "ply\nformat ascii 1.0\n", {"longer than 16777216 bytes"}, 1},
           {"b.ply",
            ply + "element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n",
            {"b.ply", "declares 4000000000"},
            1},
           {"a.3ds", "MM", {"a.3ds", "malformed"}, 1},
           {"a.glb", "glTF", {"version 0"}, 1},
           {"a.gltf", "{\"asset\":{\"version\":\"2.0\"}}", {"byte 0"}, 2},
       }) {
    SCOPED_TRACE(c.name);
    expect_refused(render(sparse(c.name, c.text, 64 * kMiB)), c.words, c.times * 64 * kKiBOfMiB + kBase);
  }
}

// The fault stands behind what was read and kept: corners, and a text.
TEST_F(Limits, AMultipleAlsoWhereTheFaultIsTheLastThing) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_refused(render(repeated("a.obj", head, "f 1 2 3\n", 16 * kMiB, "f 1 2 9\n")),
                 {"a.obj:2097153", "out of range"}, 4 * 16 * kKiBOfMiB + kBase);
  const std::string begin = R"({"asset":{"version":"2.0"},"x":[")";
  expect_refused(render(repeated("a.gltf", begin, "abcdefgh", 16 * kMiB, "\"]")), {"ends early"},
                 7 * 16 * kKiBOfMiB + kBase);
}

TEST_F(Limits, ASceneOfMoreBytesIsNotRead) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.3ds", "a.glb", "a.gltf"}) {
    SCOPED_TRACE(name);
    expect_refused(render(sparse(name, "v 0 0 0\n", 2 * kGiB)), {"2147483648 bytes", "2147483647"},
                   kBase + 64 * kKiBOfMiB);
  }
}

TEST_F(Limits, LinesAndValuesOfScenes) {
  // 17 MiB each: what is made of a line, or of values, would take many times that.
  const long most = 4 * 17 * kKiBOfMiB + kBase;
  expect_refused(render(repeated("a.obj", "f", " 1", 17 * kMiB, "")), {"a.obj:1", "longer than 16777216 bytes"}, most);
  expect_refused(render(repeated("b.obj", "", "f 1 2 3 4 5 6 7 8 9\\\n", 17 * kMiB, "")), {"longer than"}, most);
  expect_refused(render(repeated("a.gltf", "[0", ",0", 17 * kMiB, "]")), {"more than 4194304 values"}, most);
}

TEST_F(Limits, TrianglesThatAFewNodesPlace) {
  // A mesh of 3 million corners, by an accessor that repeats 36 bytes, in 200 nodes.
  std::string nodes = "{\"mesh\":0}", list = "0";
  for (int i = 1; i < 200; ++i) {
    nodes += ",{\"mesh\":0}";
    list += ',' + std::to_string(i);
  }
  const std::string size = std::to_string(36'000'000);
  const std::string text =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[)" + list + "]}],\"nodes\":[" + nodes +
      R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,)"
      R"("count":3000000,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":)" +
      size + R"(}],"buffers":[{"byteLength":)" + size + R"(,"uri":"a.bin"}]})";
  sparse("a.bin", "", 36'000'000);
  expect_refused(render(write_bytes(folder_ / "a.gltf", text)), {"triangles", "its nodes place more than"},
                 kBase + 64 * kKiBOfMiB);
  const std::string rows = "ply\nformat ascii 1.0\nelement vertex 0\nelement nothing 4000000000\nend_header\n";
  expect_refused(render(write_bytes(folder_ / "a.ply", rows)), {"4000000000 rows", "no properties"},
                 kBase + 64 * kKiBOfMiB);
}

TEST_F(Limits, AGibibyteThatIsNoTableProgramOrPart) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const std::string program = write_program(folder_, "article.json", article_state());
  expect_refused(ninebit({"eval", program, "--inputs", sparse("a.csv", "primary.r\n1\n", kGiB)}),
                 {"a.csv:3:1", "longer than 65536 bytes"}, kBase + 64 * kKiBOfMiB);
  expect_refused(ninebit({"explain", sparse("a.gl", "", kGiB)}), {"a.gl"}, kBase + 160 * kKiBOfMiB);
  expect_refused(ninebit({"study", "merge", sparse("a.jsonl", "", kGiB), "-o", folder_ / "out"}),
                 {"a.jsonl", "longer than 1048576 bytes"}, kBase + 160 * kKiBOfMiB);
  expect_refused(ninebit({"info", "--profile", sparse("a.json", "", kGiB)}), {"a.json"}, kBase + 160 * kKiBOfMiB);
}

std::string big_endian(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> static_cast<unsigned>(shift) & 255U);
  return text;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32_of(type + data));
}

// A PNG whose header promises so many pixels, with no more behind it than a compressor's first bytes.
std::string png_header(std::uint32_t width, std::uint32_t height, int bits, int color) {
  std::string header = big_endian(width) + big_endian(height);
  for (const int byte : {bits, color, 0, 0, 0}) header += static_cast<char>(byte);
  return "\x89PNG\r\n\x1A\n" + chunk("IHDR", header) + chunk("IDAT", std::string("\x78\x9C\x63\x00\x00", 5)) +
         chunk("IEND", "");
}

std::string little_endian(std::uint32_t value) {
  std::string text = big_endian(value);
  return {text.rbegin(), text.rend()};
}

// The same in EXR: four channels of floats, scan lines, of which no block is there.
std::string exr_header(std::uint32_t width, std::uint32_t height) {
  const auto attribute = [](const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + little_endian(static_cast<std::uint32_t>(value.size())) + value;
  };
  std::string channels;
  for (const char* name : {"A", "B", "G", "R"}) {
    channels +=
        name + std::string(1, '\0') + little_endian(2) + std::string(4, '\0') + little_endian(1) + little_endian(1);
  }
  channels += '\0';
  const std::string window = little_endian(0) + little_endian(0) + little_endian(width - 1) + little_endian(height - 1);
  return std::string("\x76\x2F\x31\x01\x02\0\0\0", 8) + attribute("channels", "chlist", channels) +
         attribute("compression", "compression", std::string(1, '\3')) + attribute("dataWindow", "box2i", window) +
         attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", std::string("\0\0\x80\x3F", 4)) +
         attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         attribute("screenWindowWidth", "float", std::string("\0\0\x80\x3F", 4)) + '\0' + std::string(64, '\0');
}

TEST_F(Limits, PicturesThatPromiseTooMuch) {
  struct Case {
    const char* name;
    std::string bytes;
  };
  for (const Case& c : std::vector<Case>{
           {"sides.png", png_header(1'000'000, 1'000'000, 8, 6)},
           {"pixels.png", png_header(16384, 16384, 8, 6)},
           {"sides.exr", exr_header(1U << 20U, 1U << 10U)},
           {"rows.exr", exr_header(1, 1U << 30U)},
           {"pixels.exr", exr_header(16384, 16384)},
           {"huge.dds", "DDS " + little_endian(124) + little_endian(0x1007) + little_endian(16384) +
                            little_endian(16384) + std::string(56, '\0') + little_endian(32) + little_endian(4) +
                            "DXT5" + std::string(40, '\0')},
       }) {
    SCOPED_TRACE(c.name);
    const std::string file = write_bytes(folder_ / c.name, c.bytes);
    std::string six = file;
    for (int i = 1; i < 6; ++i) six += ',' + file;
    expect_refused(render(kRoom, {"--technique", "light-cookie", "--cookie", six}), {c.name}, kBase + 160 * kKiBOfMiB);
  }
}

}  // namespace
}  // namespace tools_test
