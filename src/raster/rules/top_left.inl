// The top-left rule, of coverage; see fragment_rules.inl.

// The top-left rule (rule 21): negative for a left edge, which goes down, and for a top edge, which is level and goes
// to the left. A centre on such an edge is inside; one on another edge is outside. |dx| is less than 2^kEdgeBits.
inline constexpr int kEdgeBits = 14;
template <class O>
NINEBIT_RULE typename O::V top_left_sign(const O& o, typename O::V dx, typename O::V dy) {
  return o.add(o.shift_left(dy, kEdgeBits), dx);
}
