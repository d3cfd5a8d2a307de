// The layer's record of an OpenGL context. This header is free of OpenGL's own, whose macros exclude ninebit's names.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "src/gl_layer/context/palettes.h"
#include "src/gl_layer/driver/driver_features.h"
#include "src/gl_layer/driver/symbols.h"
#include "src/gl_layer/shader/own_programs.h"
#include "src/gl_layer/shader/shader_inputs.h"
#include "src/gl_layer/vertex_program/vertex_program_state.h"

namespace ninebit::gl_layer {

class ProgramCache;
struct CachedProgram;

// A display list that this layer plays step by step: commands of its own between lists of the driver.
struct StepList {
  std::vector<std::function<void()>> steps{};
  std::vector<unsigned> driver_lists{};  // without the program's own number
};

// State that contexts share.
struct ShareGroup {
  std::mutex mutex{};
  std::map<unsigned, std::shared_ptr<const StepList>>
      lists{};                          // by the program's number; others are the driver's alone
  std::atomic<bool> had_steps = false;  // whether there ever was one
  std::set<unsigned> step_lists{};  // the driver's lists between their commands, whose numbers the program never got
  OwnPrograms own_programs{};
  SharedVertexPrograms vertex_programs{};
  PalettedTextures paletted{};
  std::atomic<std::uint64_t> images_changed = 0;  // how often images of textures may have been made or deleted
};

// Where a list of the driver leaves a context: between glBegin and glEnd, or not; `unchanged`: it has neither command.
enum class BeginEffect : std::uint8_t { unchanged, inside, outside };

// A display list while it is compiled.
struct OpenList {
  unsigned number = 0;          // the program's
  unsigned mode = 0;            // GL_COMPILE or GL_COMPILE_AND_EXECUTE
  unsigned driver_number = 0;   // of the driver's list that is open
  bool replaces = false;        // with the first step: whether there was a list of that number before
  bool stale = false;           // whether a command in the driver's list changes what shaders depend on
  bool in_begin = false;        // between glBegin and glEnd
  bool half_begin = false;      // it has only one of a pair of glBegin and glEnd
  bool begin_error = false;     // the driver's list has a command of the layer between glBegin and glEnd
  bool ended_in_begin = false;  // glEndList, between glBegin and glEnd that execute: drivers differ
  bool draws = false;           // the driver's list may draw
  unsigned arrays = 0;          // the attributes that its draw calls take from attribute arrays
  BeginEffect effect = BeginEffect::unchanged;  // of the driver's list
  StepList list{};                              // the steps before the driver's open list
};

// The pixel transfer of NV_texture_shader: scales of HI, LO, DS, DT, magnitude and vibrance, then their biases, as
// OpenGL numbers the names from GL_HI_SCALE_NV.
using StagePixelTransfer = std::array<float, 12>;
inline constexpr StagePixelTransfer kDefaultPixelTransfer{1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0};

// The layer's own state that glPushAttrib saves.
struct SavedState {
  unsigned mask = 0;
  int depth = 0;                                   // of the driver's stack after the push
  std::unique_ptr<gl::Context> combiners{};        // for the texture group, and for the enables
  std::array<bool, kLayerUnits> no_environment{};  // for the texture group
  StagePixelTransfer pixel_transfer{};             // for the pixel mode group
  bool shared_palette = false;                     // for the texture group, and for the enables
};

// The set-up that the last draw's texture shaders were compiled for, and the textures that have all levels they need.
struct StageCache {
  StageTextures textures{};
  std::uint64_t images_changed = 0;  // when `levels` was asked for
  struct Levels {
    std::array<int, 9> seen{};  // the base level, and what else it depends on that can change without an image
    bool complete = false;
  };
  std::map<std::pair<unsigned, unsigned>, Levels> levels{};  // by target and name
};

// GL_NV_vertex_array_range.
struct VertexRange {
  bool enabled = false;
  int length = 0;
  const void* pointer = nullptr;
};

class Context {
 public:
  Context(std::shared_ptr<ShareGroup> group, const HardwareProfile& profile);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const std::shared_ptr<ShareGroup> group;
  gl::Context combiners;  // and the texture shaders' state

  // GL_TEXTURE_ENV_MODE is GL_NONE (NV_texture_shader), by unit; the driver has the mode before it.
  std::array<bool, kLayerUnits> no_environment{};

  StagePixelTransfer pixel_transfer = kDefaultPixelTransfer;

  // Whether shaders write their inputs to the colour buffers after the first: NINEBIT_GL_WRITE_INPUTS is set.
  const bool writes_inputs;
  DriverFeatures features{};  // found when the context is first made current
  // The shaders are not shared with other contexts, because constants are uniforms, which would be shared as well.
  const std::unique_ptr<ProgramCache> programs;
  // Whether the program has used the combiners or texture shaders: before that the layer only watches for it.
  bool touched = false;
  bool in_begin = false;                   // between glBegin and glEnd
  unsigned app_program = 0;                // glUseProgram's argument
  CachedProgram* program = nullptr;        // of the last draw; nullptr: drawn without combiners
  std::array<CachedProgram*, 4> of_fog{};  // by FogFactor: those of the last draw's state apart from fog, if known
  bool bound = false;                      // whether the driver's current program is this one
  ShaderInputs inputs{};                   // as of the last draw with combiners
  bool own_fragments = false;              // whether something took precedence over combiners then
  std::uint32_t frame = 0;                 // buffer swaps so far
  std::unique_ptr<OpenList> open_list{};
  int list_depth = 0;  // nested glCallList
  std::vector<SavedState> attribute_stack{};

  StageCache stage_cache{};
  std::map<unsigned, bool> fences{};  // GL_NV_fence, by name: whether it was set
  VertexRange vertex_range{};
  std::vector<std::optional<VertexRange>> saved_ranges{};  // for each glPushClientAttrib
  SharedPalette shared_palette{};
  VertexProgramState vertex{};  // GL_NV_vertex_program
  Program shown{};              // the combiners' program, normalized, as of the last draw with a shader of the layer

  // Changes since the last draw.
  bool inputs_changed = true;   // the inputs differ from those of the last draw
  bool inputs_stale = true;     // enabled textures, fog, lighting, the program's own shaders
  bool fog_stale = true;        // fog alone, which programs switch on and off often
  bool program_stale = true;    // the combiners' state, apart from constants
  bool constants_stale = true;  // and the numbers of texture-shader stages

  // The pending error of a command that the layer executes: GL keeps the first until glGetError.
  void raise(unsigned error);
  unsigned pending_error = 0;
  unsigned begin_error =
      0;  // raised between glBegin and glEnd, where the driver cannot be asked for an error of before
  // After glEnd.
  void begin_has_ended();

  // Runs a command of the front end, gl_nv.h; its error becomes this context's. Returns whether there was none.
  template <class Command>
  bool run(const Command& command) {
    const gl::CurrentContext current(combiners);
    command();
    const auto error = static_cast<unsigned>(combiners.take_error());
    if (error != 0) raise(error);
    return error == 0;
  }

  // A function that the layer executes: GL forbids it between glBegin and glEnd. Raises the error and returns false.
  bool outside_begin();

  // Whether draw calls have to be looked at.
  [[nodiscard]] bool watches_draws() const { return touched; }
  // Whether commands that the layer has to see when they are executed go into a display list as its steps.
  [[nodiscard]] bool recording() const {
    return open_list != nullptr && (touched || features.extras.have(Extra::vertex_program) || combiners_looked_up());
  }
  // Whether the next command is between glBegin and glEnd, of a list or not.
  [[nodiscard]] bool next_in_begin() const { return in_begin || (open_list != nullptr && open_list->in_begin); }
  // Whether the next command of the open list is between glBegin and glEnd.
  [[nodiscard]] bool list_in_begin() const { return in_begin || open_list->in_begin; }

  std::string extensions{};  // glGetString(GL_EXTENSIONS), once a program has asked

  // Everything may have changed.
  void forget() { inputs_stale = program_stale = constants_stale = true; }
};

// This thread's context; nullptr: none, or one that the layer leaves alone.
extern constinit thread_local Context* current_context [[gnu::tls_model("initial-exec")]];

[[nodiscard]] inline Context* current() {
  return current_context;
}

// The name that the driver gets for a program's name: one that no driver gives out for a program of the layer's own.
[[nodiscard]] inline unsigned visible_program(unsigned name) {
  const Context* const context = current();
  return context != nullptr && context->group->own_programs.has(name) ? ~0U : name;
}

// The profile for new contexts: the one that NINEBIT_GL_PROFILE names, else the one of the GeForce 3 class, which has
// all extensions. A name that does not fit is reported once.
[[nodiscard]] const HardwareProfile& layer_profile();

}  // namespace ninebit::gl_layer
