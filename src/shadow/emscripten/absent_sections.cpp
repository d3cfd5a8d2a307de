// Stand-ins for meshoptimizer's functions: Emscripten has its headers alone. The page asks for no
// sections; whoever does gets none.
#include <meshoptimizer.h>

extern "C" {

size_t meshopt_buildMeshletsBound(size_t, size_t, size_t) {
  return 0;
}

size_t meshopt_buildMeshlets(meshopt_Meshlet*, unsigned int*, unsigned char*, const unsigned int*, size_t, const float*,
                             size_t, size_t, size_t, size_t, float) {
  return 0;
}
}
