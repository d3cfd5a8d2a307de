// What must hold of each parser, and of the evaluators, whatever bytes they are given. The fuzzers call these functions
// with what libFuzzer makes up, and the tests of the rooms with the kept corpora.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::fuzz {

// Each reads the bytes as a file of its form and answers what is wrong with the parser; empty: nothing. Where the bytes
// are a program, its state must be valid and compile, and come back from every form that can express it. Where they are
// none, there must be 1 to kMaxTextFaults faults, each with a message and a place within the text.
using Check = std::string (*)(std::string_view bytes);

std::string check_gl(std::string_view bytes);       // GL calls
std::string check_source(std::string_view bytes);   // a source file
std::string check_rc10(std::string_view bytes);     // !!RC1.0
std::string check_ps(std::string_view bytes);       // a pixel shader of Direct3D 8 in assembly
std::string check_words(std::string_view bytes);    // register words as NAME = 0x… lines
std::string check_xbox(std::string_view bytes);     // the Xbox's pixel shader definition, in every shape
std::string check_log(std::string_view bytes);      // a log of register writes, which reads alike in any pieces
std::string check_json(std::string_view bytes);     // the canonical form, and register words as JSON
std::string check_form(std::string_view bytes);     // any form, found by its content, and back through every other
std::string check_profile(std::string_view bytes);  // a hardware profile, which must compute alike in both evaluators
std::string check_csv(std::string_view bytes);      // a table for `eval`, which reads alike in any pieces

// A state, a profile and registers made of the bytes as random numbers; every evaluator must give what the reference
// does, and a state that GL refuses must not compile.
std::string check_state(std::string_view bytes);

// A part of a study, as it is and with each line's hash made to fit. What is read must come back when it is written,
// and join; a run must go on with it to its end or say why not, and leave it alone then.
std::string check_part(std::string_view bytes);
// What check_part reads after it has read the bytes themselves: a line gets the hash that fits it; one that begins with
// '!' stays as it is, without that.
std::string with_hashes(std::string_view bytes);

std::string check_effect(std::string_view bytes);  // an effect, which is drawn small
std::string check_dds(std::string_view bytes);     // a DDS file: texture or refusal, and mip-maps that are all there
std::string check_scene(std::string_view bytes);   // a scene file of each format, through its whole reader

}  // namespace ninebit::fuzz
