#include "src/page/diagram_page.h"

#include <algorithm>
#include <string_view>

#include "src/page/page_texts.h"
#include "src/system/quoting.h"

namespace ninebit {
namespace {

// The modules import each other's functions by name. In one script all of them are in scope: its lines are the modules'
// lines without `import …` lines and without `export` before declarations.
void append_plain_script(std::string& script, std::string_view module) {
  constexpr std::string_view kExport = "export ";
  while (!module.empty()) {
    const std::size_t end = std::min(module.find('\n'), module.size() - 1) + 1;
    std::string_view line = module.substr(0, end);
    module.remove_prefix(end);
    if (line.starts_with("import ")) continue;
    if (line.starts_with(kExport)) line.remove_prefix(kExport.size());
    script += line;
  }
}

std::string diagram_script() {
  std::string script;
  for (const std::string_view module :
       {kDiagramStyleModule, kDiagramLayoutModule, kDiagramWordsModule, kDiagramPartsModule, kStageModelModule,
        kTraceModelModule, kProgramModelModule, kTraceDiagramModule, kPassSwitchModule}) {
    append_plain_script(script, module);
  }
  return script;
}

std::string facts_of(const DiagramPage& page) {
  std::string out = "<dl>\n";
  for (const auto& [name, value] : page.facts) {
    out += "<div><dt>" + escaped_markup(name) + "</dt><dd>" + escaped_markup(value) + "</dd></div>\n";
  }
  return out + "</dl>\n";
}

std::string data_element(const char* id, const std::string& json) {
  if (json.empty()) return {};
  return std::string("<script type=\"application/json\" id=\"") + id + "\">" + script_json(json) + "</script>\n";
}

}  // namespace

std::string diagram_page(const DiagramPage& page) {
  const bool traced = !page.passes.empty(), drawn = traced || !page.program.empty();
  const std::string title = escaped_markup(page.title);
  // The policy makes browsers refuse all external resources.
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data:\">\n<link rel=\"icon\" href=\"data:,\">\n<title>" +
      title + " – " + escaped_markup(page.kind) + "</title>\n<style>\n";
  out += kPageLook;
  out += "</style>\n</head>\n<body>\n<header>\n<p class=\"kind\">" + escaped_markup(page.kind) + "</p>\n<h1>" + title +
         "</h1>\n" + facts_of(page) + "</header>\n<main>\n";
  if (drawn)
    out +=
        "<div id=\"diagram\"><noscript>The diagram needs JavaScript. The text below has the same "
        "content.</noscript></div>\n";
  out += std::string("<details") + (drawn ? "" : " open") + "><summary>As text</summary>\n<pre tabindex=\"0\">" +
         escaped_markup(page.text) + "</pre></details>\n</main>\n";
  if (drawn) {
    out += data_element("passes", page.passes) + data_element("program", page.program) +
           data_element("explanation", page.explanation) + "<script type=\"module\">\n" + diagram_script() +
           "const readData = (id) => JSON.parse(document.getElementById(id)?.textContent ?? 'null');\n"
           "const diagramElement = document.getElementById('diagram');\n" +
           (traced ? "passSwitch(diagramElement, readData('passes'));\n"
                   : "programDiagram(diagramElement, readData('program'), { explanation: readData('explanation') ?? "
                     "undefined });\n") +
           "</script>\n";
  }
  return out + "</body>\n</html>\n";
}

}  // namespace ninebit
