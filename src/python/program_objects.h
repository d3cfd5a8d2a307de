// The C++ objects behind ninebit.State and ninebit.Program, whose Python classes are in src/python/ninebit.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/language/program_text.h"
#include "src/python/module.h"

namespace ninebit::python {

struct State {
  CombinerState state;
  ProfileChoice profile;
  std::vector<std::string> notes{};     // what parsing skipped or assumed
  TextureShaderState texture_shader{};  // the stages before the combiners
};

struct RunnableProgram {
  State state;
  Program program;
  BatchProgram batch;
  BatchProgram of_bytes;  // the same for registers that are not negative
};

}  // namespace ninebit::python

// pybind11 returns uninitialized memory for an object whose __init__ never ran, as after Program.__new__(Program); this
// caster throws a TypeError instead.
namespace pybind11::detail {

template <class T>
struct made_object_caster : type_caster_base<T> {
  bool load(handle source, bool convert) {
    if (this->typeinfo != nullptr && PyObject_TypeCheck(source.ptr(), this->typeinfo->type) != 0) {
      auto* const object = reinterpret_cast<instance*>(source.ptr());
      if (!object->get_value_and_holder(this->typeinfo).holder_constructed()) {
        throw type_error(std::string(this->typeinfo->type->tp_name) +
                         ".__init__() has not run; expected an object made by calling the class");
      }
    }
    return type_caster_base<T>::load(source, convert);
  }
};

template <>
struct type_caster<ninebit::python::State> : made_object_caster<ninebit::python::State> {};
template <>
struct type_caster<ninebit::python::RunnableProgram> : made_object_caster<ninebit::python::RunnableProgram> {};

}  // namespace pybind11::detail
