// What the tests of the program share: scenes, folders, errors as users see them, pictures read back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "combiner_tests/support/temp_folder.h"
#include "combiner_tests/tools/child_process.h"

namespace tools_test {

using ninebit::test::read_bytes;
using ninebit::test::TempFolder;
using ninebit::test::write_bytes;
using Json = nlohmann::ordered_json;
// The line that called: std::source_location, which Clang 14 has not.
struct Place {
  const char* file;
  int line;
  static Place current(const char* file = __builtin_FILE(), int line = __builtin_LINE()) { return {file, line}; }
};
using Files = std::map<std::string, std::string>;  // name: bytes

inline const std::string kRoom = NINEBIT_SOURCE_DIR "/scenes/index_room.gltf";
inline const std::string kCornell = NINEBIT_SOURCE_DIR "/scenes/cornell_box.gltf";
inline const std::string kBunny = "/usr/share/glmark2/models/bunny.obj";
inline const std::string kEngine = "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb";

// All files of a folder, hidden ones included; none where there is no such folder.
Files files_in(const std::filesystem::path& folder);

// Whether the folder has a file of such a name.
bool has_file(const std::string& folder, const std::function<bool(const std::string& name)>& is_it);

// The words of a command, and more of them.
Words operator+(Words words, const Words& more);

// The arguments of a rendering that is over soon, and more.
Words small_render(const std::string& scene, const std::string& folder, const Words& more = {});

// Runs a shell command: both its streams, and its exit status.
std::pair<std::string, int> shell(const std::string& command);

// The CRC-32 of PNG and ZIP files.
std::uint32_t crc32_of(std::string_view bytes);

// A text's lines, without their ends.
Words lines_of(const std::string& text);

// The object that a command with --json printed before it failed with `code`: its errors. Fails without one.
Json faults_of(const Outcome& outcome, int code);

// Fails unless the text holds every one of `parts`.
void expect_parts(const std::string& text, const Words& parts, const Place& place = Place::current());

// Fails unless the program ended with `code`, wrote nothing to stdout, and to stderr one line of its own that holds
// every one of `words`.
void expect_error(const Outcome& outcome, int code, const Words& words, const Place& place = Place::current());

// stdout, or stderr, of a program that ended with `code`; fails where it ended with another one.
std::string out_of(const Outcome& outcome, int code = 0, const Place& place = Place::current());
std::string err_of(const Outcome& outcome, int code = 0, const Place& place = Place::current());

// The help of every verb, by its name: "", "study", "study index-steps".
const std::map<std::string, std::string>& help_of_all_verbs();

// The object that a command printed; fails (and is null) unless it ended with `code` and stdout is one JSON object.
Json json_of(const Outcome& outcome, int code = 0, const Place& place = Place::current());
// The data of a page's script element "data".
Json data_of(const std::string& page);
// Whether each trace of a page that has a text has that of its command; counts them.
void expect_traces(const Json& traces, std::size_t& texts);

// The keys of an object, in order.
Words keys_of(const Json& object);

}  // namespace tools_test
