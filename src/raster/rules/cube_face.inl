// The face of a cube map that a direction meets, and the place on it; see fragment_rules.inl.

// Where a direction meets the cube; see cube_coordinate.
template <class O>
struct CubePlace {
  typename O::V face;  // a CubeFace
  typename O::F s, t;
};

// The major-axis table of ARB_texture_cube_map. On ties x wins over y and y over z; a zero counts as positive. The zero
// direction, as NaN, is the first place of +X (rule 41).
template <class O>
NINEBIT_RULE CubePlace<O> cube_place(const O& o, typename O::F rx, typename O::F ry, typename O::F rz) {
  const auto zero = o.set(0.0F), half = o.set(0.5F), one = o.set(1.0F);
  const auto ax = o.abs_of(rx), ay = o.abs_of(ry), az = o.abs_of(rz);
  const auto not_x = o.any(o.less(ax, ay), o.less(ax, az));
  const auto is_z = o.all(not_x, o.less(ay, az));
  const auto is_y = o.without(is_z, not_x);
  const auto major = o.select(is_z, rz, o.select(is_y, ry, rx));
  const auto ma = o.abs_of(major);
  const auto negative = o.less(major, zero);
  // sc and tc are components, negated on some faces.
  const auto sc_positive = o.select(not_x, rx, o.negated(rz));
  const auto sc = o.select(o.without(is_y, negative), o.negated(sc_positive), sc_positive);
  const auto tc_positive = o.select(is_y, rz, o.negated(ry));
  const auto tc = o.select(o.all(is_y, negative), o.negated(tc_positive), tc_positive);
  const auto s = o.mul(o.add(o.div(sc, ma), one), half);
  const auto t = o.mul(o.add(o.div(tc, ma), one), half);
  // Infinity over infinity, or 0 over 0, is NaN, which fails both comparisons.
  const auto s_is_on_face = o.all(o.greater_equal(s, zero), o.less_equal(s, one));
  const auto t_is_on_face = o.all(o.greater_equal(t, zero), o.less_equal(t, one));
  const auto is_number = o.all(o.all(o.equal(rx, rx), o.equal(ry, ry)), o.equal(rz, rz));
  CubePlace<O> place;
  place.face = o.number_where(is_z, static_cast<int>(CubeFace::positive_z),
                              o.number_where(is_y, static_cast<int>(CubeFace::positive_y), o.set(0)));
  place.face = o.add(place.face, o.number_where(negative, 1, o.set(0)));
  place.face = o.where(is_number, place.face);
  place.s = o.where(o.all(is_number, s_is_on_face), s);
  place.t = o.where(o.all(is_number, t_is_on_face), t);
  return place;
}
