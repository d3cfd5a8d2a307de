// The fuzzer's corpus of scenes, replayed without libFuzzer.
#include "combiner_tests/fuzz/corpus.h"

#include <gtest/gtest.h>

#include "src/scene/files/scene_readers.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Scene) {
  replay("scene", check_scene, [](std::string_view bytes) {
    const std::filesystem::path file("/nonexistent/scene.3ds");
    const NamedFiles beside(file, false);
    const SceneFile from{file, beside};
    return read_off(bytes).ok() || read_ply(bytes).ok() || read_3ds(from, bytes, {}).ok() ||
           read_gltf(from, bytes, false, {}).ok() || read_gltf(from, bytes, true, {}).ok();
  });
}

}  // namespace
}  // namespace ninebit::fuzz
