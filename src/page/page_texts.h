// The texts of pages, embedded in the program at build time.
#pragma once

#include <string_view>

namespace ninebit {

extern const std::string_view kPageLook;             // page.css
extern const std::string_view kDiagramStyleModule;   // web/diagram_style.js
extern const std::string_view kDiagramLayoutModule;  // web/diagram_layout.js
extern const std::string_view kDiagramWordsModule;   // web/diagram_words.js
extern const std::string_view kDiagramPartsModule;   // web/diagram_elements.js
extern const std::string_view kStageModelModule;     // web/stage_model.js
extern const std::string_view kTraceModelModule;     // web/trace_model.js
extern const std::string_view kProgramModelModule;   // web/program_model.js
extern const std::string_view kTraceDiagramModule;   // web/trace_diagram.js
extern const std::string_view kPassSwitchModule;     // web/pass_switch.js

}  // namespace ninebit
