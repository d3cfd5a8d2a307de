// The house keeps its walls: #include lines go one way, and each outside library stays in its room.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

// A room knows the rooms of a lower rank and itself. system and numerics do not know each other, nor do scene and
// image, effect and shadow, capi and raster, or playground and bench.
const std::map<std::string, int> kRank{{"system", 0},   {"numerics", 0}, {"combiner", 1},   {"texture_shader", 2},
                                       {"language", 3}, {"capi", 4},     {"raster", 4},     {"scene", 5},
                                       {"image", 5},    {"frame", 6},    {"shadow", 7},     {"effect", 7},
                                       {"study", 8},    {"page", 6},     {"playground", 9}, {"bench", 9},
                                       {"tools", 10},   {"python", 11},  {"gl_layer", 10}};

// The folders of rooms in src/. A folder knows those before it and itself; files that stand beside the folders come
// last.
const std::map<std::string, std::vector<std::string>> kFolders{
    {"system", {"emscripten", "parallel", "", "hashing"}},
    {"language",
     {"source", "c_like", "gl_nv", "gl_calls", "rc10", "pixel_shader", "register_words", "xbox", "register_log",
      "source_code", "emit", "explain", "json"}},
    {"raster", {"rules", "surface", "texture", "setup", "fragment", "lanes", "draw"}},
    {"scene", {"", "files", "emscripten"}},
    {"image", {"output", "texture", "openimageio", "module"}},
    {"shadow",
     {"index_order", "index_cube", "depth_cube", "shadow_map", "shadow_volume", "reflective", "light_cookie",
      "ground_truth", "embree", "", "files", "emscripten"}},
    {"effect", {"", "files"}},
    {"playground", {"", "emscripten"}},
    {"gl_layer", {"driver", "shader", "vertex_program", "context", "draw", "capture", "calls"}},
    {"study",
     {"part", "report", "page", "proof", "vectors", "digits", "index_steps", "datapath", "shadows", "depth_packing"}},
    {"tools",
     {"input", "common", "help", "eval", "draw", "trace", "verify", "render", "compare", "bench", "study", "prove",
      "vectors", ""}},
};

// Outside libraries and the rooms that may include them. Besides these there is only the standard library, whose
// headers have neither a dot nor a slash in their names.
struct Library {
  std::regex header;
  std::vector<std::string> rooms;
};
const std::vector<Library> kLibraries{
    {std::regex("hwy/.*"), {"system", "combiner", "texture_shader", "raster", "shadow", "study", "bench"}},
    {std::regex("oneapi/tbb/.*"), {"system"}},
    {std::regex("fmt/.*"), {"system", "scene", "image", "frame", "shadow", "study", "tools"}},
    {std::regex("glm/.*"), {"raster", "scene", "frame", "shadow", "effect", "study", "tools", "bench"}},
    {std::regex("assimp/.*|draco/.*"), {"scene"}},
    {std::regex("meshoptimizer\\.h"), {"shadow"}},
    {std::regex("embree3/.*"), {"shadow"}},
    {std::regex("OpenImageIO/.*|png\\.h|Imf.*|openexr\\.h|OpenEXR/.*|Iex.*|half\\.h|Imath.*"), {"image"}},
    {std::regex("CLI/.*"), {"tools"}},
    {std::regex("zlib\\.h"), {"image", "tools"}},
    {std::regex("openssl/.*"), {"system"}},
    {std::regex("pybind11/.*"), {"python"}},
    {std::regex("nlohmann/.*"), {"language", "scene", "effect", "study", "playground", "tools", "gl_layer"}},
    {std::regex("dlfcn\\.h"), {"system", "gl_layer"}},
    {std::regex("link\\.h"), {"gl_layer"}},
    {std::regex("(fcntl|poll|sched|spawn|stdlib|unistd)\\.h|(sys|linux)/.*"), {"system"}},
    {std::regex("GL/(gl|glext)\\.h"), {"gl_layer"}},
    {std::regex("std(bool|def|int)\\.h"), {"capi", "combiner"}},  // of headers for C
    {std::regex("benchmark/.*|EGL/.*|GL/glcorearb\\.h"), {"bench"}},
};

// The room that a path of ours belongs to: "ninebit/ROOM/…" or "src/ROOM/…".
std::optional<std::string> room_of(const std::string& path) {
  static const std::regex ours("(?:include/)?(?:ninebit|src)/([a-z0-9_]+)/.*");
  std::smatch match;
  if (!std::regex_match(path, match, ours)) return std::nullopt;
  return match[1].str();
}

// The fault of one #include of a file in `room`; empty: none.
std::string complaint(const std::string& room, const std::string& header) {
  if (const auto other = room_of(header)) {
    if (kRank.count(*other) == 0) return "unknown room " + *other;
    if (*other != room && kRank.at(*other) >= kRank.at(room)) return room + " must not know " + *other;
    return {};
  }
  for (const Library& library : kLibraries) {
    if (!std::regex_match(header, library.header)) continue;
    const auto& rooms = library.rooms;
    if (std::find(rooms.begin(), rooms.end(), room) == rooms.end()) return header + " has no place in " + room;
    return {};
  }
  return header.find_first_of("./") == std::string::npos ? "" : header + " belongs to no library that the house knows";
}

// The place among its room's folders of a file "src/ROOM/FOLDER/…" or "src/ROOM/…"; nothing where the room does not
// have this folder.
std::optional<std::ptrdiff_t> floor_of(const std::string& path) {
  static const std::regex place("src/([a-z0-9_]+)/(?:([a-z0-9_]+)/)?[^/]+");
  std::smatch match;
  if (!std::regex_match(path, match, place)) return std::nullopt;
  const auto room = kFolders.find(match[1].str());
  if (room == kFolders.end()) return std::nullopt;
  const auto folder = std::find(room->second.begin(), room->second.end(), match[2].str());
  if (folder == room->second.end()) return std::nullopt;
  return folder - room->second.begin();
}

// The fault of the place of the file `path`, or of its #include of a header of the same room; empty: none.
std::string complaint_within(const std::string& path, const std::string& header) {
  const auto room = room_of(path);
  if (path.rfind("src/", 0) != 0 || kFolders.count(*room) == 0) return {};
  const auto own = floor_of(path);
  if (!own) return "is in no folder of its room";
  if (header.rfind("src/", 0) != 0 || room_of(header) != room) return {};
  const auto other = floor_of(header);
  if (!other) return header + " is in no folder of its room";
  return *other <= *own ? "" : "must not know " + header;
}

std::vector<std::string> includes_of(const fs::path& file) {
  std::vector<std::string> found;
  std::ifstream in(file);
  static const std::regex include("\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    // The regular expression alone would take most of the test's time.
    if (line.find("include") != std::string::npos && std::regex_match(line, match, include))
      found.push_back(match[1].str());
  }
  return found;
}

TEST(Layering, IncludesGoOneWay) {
  const fs::path top = NINEBIT_SOURCE_DIR;
  int files = 0, includes = 0;
  for (const char* folder : {"include/ninebit", "src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp" && extension != ".inl") continue;
      const std::string path = fs::relative(entry.path(), top).string();
      const auto room = room_of(path.rfind("include/", 0) == 0 ? path.substr(8) : path);
      if (!room) continue;  // include/ninebit/ninebit.h, which includes everything
      ++files;
      ASSERT_EQ(kRank.count(*room), 1U) << path << " is in no room of the house";
      for (const std::string& header : includes_of(entry.path())) {
        ++includes;
        EXPECT_EQ(complaint(*room, header), "") << path;
        EXPECT_EQ(complaint_within(path, header), "") << path;
      }
    }
  }
  EXPECT_GT(files, 40);
  EXPECT_GT(includes, 150);
}

TEST(Layering, NoticesWhatIsForbidden) {
  EXPECT_NE(complaint("numerics", "ninebit/combiner/state.h"), "");
  EXPECT_NE(complaint("raster", "ninebit/scene/scene.h"), "");
  EXPECT_NE(complaint("scene", "ninebit/image/image_io.h"), "");
  EXPECT_NE(complaint("image", "src/scene/files/mesh_builder.h"), "");
  EXPECT_NE(complaint("shadow", "src/tools/input/program.h"), "");
  EXPECT_NE(complaint("shadow", "assimp/scene.h"), "");
  EXPECT_NE(complaint("image", "draco/compression/decode.h"), "");
  EXPECT_NE(complaint("tools", "OpenImageIO/imageio.h"), "");
  EXPECT_NE(complaint("raster", "GL/gl.h"), "");
  EXPECT_NE(complaint("combiner", "glm/glm.hpp"), "");
  EXPECT_NE(complaint("numerics", "boost/any.hpp"), "");
  EXPECT_NE(complaint("raster", "unistd.h"), "");
  EXPECT_NE(complaint("capi", "ninebit/raster/surface.h"), "");
  EXPECT_NE(complaint("raster", "ninebit/capi/combiner.h"), "");
  EXPECT_EQ(complaint("shadow", "ninebit/raster/surface.h"), "");
  EXPECT_EQ(complaint("scene", "assimp/scene.h"), "");
  EXPECT_EQ(complaint("scene", "vector"), "");
  EXPECT_NE(complaint_within("src/raster/setup/clip.h", "src/raster/draw/tile.h"), "");
  EXPECT_NE(complaint_within("src/raster/clip.h", "vector"), "");
  EXPECT_NE(complaint_within("src/raster/draw/tile.h", "src/raster/clip.h"), "");
  EXPECT_EQ(complaint_within("src/raster/draw/tile.h", "src/raster/setup/clip.h"), "");
  EXPECT_EQ(complaint_within("src/shadow/technique.cpp", "src/shadow/index_cube/index_cube_renderer.h"), "");
}

// What a public header declares can be linked to in the shared libraries, and only that.
TEST(Layering, PublicHeadersSayThatTheyAre) {
  const fs::path top = NINEBIT_SOURCE_DIR;
  int headers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(top / "include/ninebit")) {
    if (entry.path().extension() != ".h") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      if (line.rfind("namespace ", 0) != 0 || line.rfind("namespace NINEBIT_PUBLIC ninebit {", 0) == 0) continue;
      const bool nested = line.find("ninebit") == std::string::npos;
      EXPECT_TRUE(nested) << entry.path() << " should say: namespace NINEBIT_PUBLIC ninebit {";
    }
    ++headers;
  }
  EXPECT_GT(headers, 40);
}

TEST(Layering, FilesStayReadable) {
  const fs::path top = NINEBIT_SOURCE_DIR;
  for (const char* folder : {"include/ninebit", "src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      // npm writes its list of packages itself, and generate.py one file for emulators to copy.
      const fs::path name = entry.path().filename();
      if (!entry.is_regular_file() || name == "package-lock.json" || name == "ninebit_combiner.c") continue;
      std::ifstream in(entry.path());
      int lines = 0;
      for (std::string line; std::getline(in, line);) ++lines;
      EXPECT_LE(lines, 500) << entry.path() << " should be split: one subject a file";
    }
  }
}

}  // namespace
