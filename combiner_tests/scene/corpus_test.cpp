// The fuzzer's corpus of scenes, replayed without libFuzzer.
#include "combiner_tests/fuzz/corpus.h"

#include <gtest/gtest.h>

#include "src/scene/file_check.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Scene) {
  replay("scene", check_scene, [](std::string_view bytes) {
    return check_off(bytes).ok() || check_ply(bytes).ok() || check_3ds(bytes).ok() ||
           check_gltf(bytes, "", false).ok() || check_gltf(bytes, "", true).ok();
  });
}

}  // namespace
}  // namespace ninebit::fuzz
