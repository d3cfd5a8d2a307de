// ninebit::ninebit in somebody else's project: a scene's shadows, judged by rays. Through ninebit.h, which has it all.
#include <ninebit/language/json.h>
#include <ninebit/ninebit.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: %s SCENE\n", argv[0]), 2;
  auto read = ninebit::read_scene(argv[1]);
  if (!read) return std::fprintf(stderr, "%s\n", read.error().text().c_str()), 1;
  const auto scene = ninebit::complete_scene(std::move(*read), {}, 1.0F);
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().text().c_str()), 1;
  ninebit::RenderSettings settings;
  settings.width = settings.height = 64;
  settings.map_size = 64;
  const auto drawn = ninebit::find_technique("index-cube")->render(*scene, settings, {});
  if (!drawn) return std::fprintf(stderr, "%s\n", drawn.error().text().c_str()), 1;
  // Something of every library that stands behind the header.
  const bool linked = !ninebit::print_json_program({}).empty() && ninebit::simd_target() != nullptr &&
                      !ninebit::read_texture(ninebit::profiles::geforce2, "none.png");
  std::printf("%llu pixels in shadow\n", linked ? static_cast<unsigned long long>(drawn->shadowed) : 0ULL);
}
