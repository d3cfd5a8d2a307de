// The fuzzer's corpus of scenes, replayed without libFuzzer.
#include "combiner_tests/fuzz/corpus.h"

#include <gtest/gtest.h>

#include "src/scene/scene_readers.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Scene) {
  replay("scene", check_scene, [](std::string_view bytes) {
    const NamedFiles beside("/nonexistent/scene.obj", false);
    return read_off(bytes).ok() || read_ply(bytes).ok() || read_3ds(bytes, "scene.3ds", {}).ok() ||
           read_gltf(bytes, beside, false, {}).ok() || read_gltf(bytes, beside, true, {}).ok();
  });
}

}  // namespace
}  // namespace ninebit::fuzz
