// Pages with the diagrams of a pixel's traces, or of a program. They need no other file and load nothing.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ninebit {

// The content of such a page. Texts are UTF-8 and may have any content: the page shows markup and does not run it.
struct DiagramPage {
  std::string kind{};                                        // above the title: "ninebit trace"
  std::string title{};                                       // of the page
  std::vector<std::pair<std::string, std::string>> facts{};  // names and values, in this order
  std::string passes{};                                      // traces, as pass_switch.js reads them; empty: none
  std::string program{};                                     // its canonical JSON form, if there is no trace
  std::string explanation{};                                 // of the program, as `ninebit explain --json` prints it
  std::string text{};                                        // the same for people, lines of text
};

// The page as HTML. With neither a trace nor a program it has no diagram.
[[nodiscard]] std::string diagram_page(const DiagramPage& page);

}  // namespace ninebit
