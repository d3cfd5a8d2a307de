// Stencil operations, those that wrap among them, and the write mask; see fragment_rules.inl.

// The stencil value after an operation; both values are at most `largest`, which is 2^bits - 1. Nothing is masked.
template <class O>
NINEBIT_RULE typename O::V stencil_result(const O& o, StencilOperation operation, typename O::V stored,
                                          typename O::V reference, typename O::V largest) {
  switch (operation) {
    case StencilOperation::keep:
      return stored;
    case StencilOperation::zero:
      return o.set(0);
    case StencilOperation::replace:
      return reference;
    case StencilOperation::incr:
      return o.min_of(o.add(stored, o.set(1)), largest);
    case StencilOperation::decr:
      return o.max_of(o.sub(stored, o.set(1)), o.set(0));
    case StencilOperation::invert:
      return o.bits_and_not(stored, largest);
    case StencilOperation::incr_wrap:
      return o.bits_and(o.add(stored, o.set(1)), largest);
    case StencilOperation::decr_wrap:
      return o.bits_and(o.sub(stored, o.set(1)), largest);
  }
  return stored;
}

// The write mask: bits that it has not keep their stored value.
template <class O>
NINEBIT_RULE typename O::V write_masked(const O& o, typename O::V stored, typename O::V result,
                                        typename O::V writable) {
  return o.bits_or(o.bits_and(result, writable), o.bits_and_not(writable, stored));
}
