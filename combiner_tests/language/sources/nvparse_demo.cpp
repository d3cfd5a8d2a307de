// Programs in strings, loaded by NVIDIA's library.
#include <nvparse.h>

static const char* diffuse =
    "!!RC1.0                                  \n"
    "// the light's direction in the colour   \n"
    "{                                        \n"
    "  rgb {                                  \n"
    "    spare0 = expand(tex0) . expand(col0);\n"
    "  }                                      \n"
    "}                                        \n"
    "out.rgb = spare0 * tex1;                 \n"
    "out.a = unsigned_invert(zero);           \n";

const char unused[] = R"glsl(
// a comment
!!RC1.0
out.rgb = tex0;
)glsl";

void init_programs() {
  nvparse("!!TS1.0\ntexture_2d();\ntexture_2d();\n");
  nvparse(diffuse);
  for (char* const* error = nvparse_get_errors(); *error; error++) fprintf(stderr, "%s\n", *error);
}
