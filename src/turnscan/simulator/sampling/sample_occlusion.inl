// Part of sample_kernel.inl, behind sample_packet.inl.
//
// Where the other eye lies beside the rays' origin along the rows (or columns) of the image, the
// way from a surface to it stays in the plane of its row. There, with the direction x and the
// inverse depth w of a point, x - b w is its direction as the other eye sees it (b: distance of the
// eyes). What hides a point from the other eye lies further towards it in the row and has a
// direction there that is no greater; and where it is itself hidden from the rays, what hides it
// serves as well. So a running minimum along the row tells which points nothing can hide: for all
// others a ray is traced. Between two samples of a row a surface is taken to end anywhere where it
// does not go on smoothly. What fits between two samples is missed: things thinner than a pixel.

/// In pixels: a smooth surface moves less than the first between two samples, and ends less than
/// the second beyond one.
constexpr float kSmooth_px = 0.75f;
constexpr float kMargin_px = 2.0f;
constexpr float kRounding_px = 0.02f;

/// Samples that need a ray to the other eye, sixteen at a time.
class Doubts {
 public:
  Doubts(const View& view, const Output& out) : view_(view), out_(out) {}

  void add(std::size_t at, float x, float y) {
    at_[count_] = at;
    x_[count_] = x;
    y_[count_] = y;
    if (++count_ == kLanes) trace();
  }

  void trace() {
    const int n = count_;
    if (n == 0) return;
    Packet p;
    for (int i = 0; i < kLanes; ++i) load_sample(i, i < n ? i : n - 1, p);
    count_ = 0;
    Target target;
    const I valid = all(-1);
    judge(view_, valid, p, target);
    I left = valid;
    for (int b = 0; b < view_.body_count && any(left); ++b)
      left = lit(view_.bodies[b], target, left, query_);
    for (int i = 0; i < n; ++i)
      if (left[i] == 0) out_.miss[at_[i]] = std::uint8_t(view_.blocked);
  }

 private:
  void load_sample(int lane, int from, Packet& p) {
    const std::size_t at = at_[from];
    p.x[lane] = x_[from];
    p.y[lane] = y_[from];
    p.z[lane] = out_.z[at];
    const BodyView& body = view_.bodies[out_.surface[at] >> kObjectBits];
    float n[3] = {0.0f, 1.0f, 0.0f};
    const std::uint32_t object = out_.surface[at] & ((1u << kObjectBits) - 1u);
    if (object != kPlatterObject) normal_of(body.objects[object], out_.triangle[at], n);
    const float* r = body.rotation;
    p.nx[lane] = r[0] * n[0] + r[3] * n[1] + r[6] * n[2];
    p.ny[lane] = r[1] * n[0] + r[4] * n[1] + r[7] * n[2];
    p.nz[lane] = r[2] * n[0] + r[5] * n[1] + r[8] * n[2];
  }

  static void normal_of(const ObjectView& object, std::uint32_t triangle, float* n) {
    const std::uint32_t* index = object.indices + 3 * std::size_t(triangle);
    const float* a = object.vertices + 3 * std::size_t(index[0]);
    const float* b = object.vertices + 3 * std::size_t(index[1]);
    const float* c = object.vertices + 3 * std::size_t(index[2]);
    const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const float v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
  }

  const View& view_;
  const Output& out_;
  embree::Query query_{true};
  std::size_t at_[kLanes];
  float x_[kLanes], y_[kLanes];
  int count_ = 0;
};

/// One row, from the side of the other eye to the far side: sample k lies at first + k * step.
/// along[k * step] is its direction in the row, sign: of the other eye's place.
struct Row {
  std::size_t first;
  std::ptrdiff_t step;
  int count;
  const float* along;  ///< of the first sample
  std::ptrdiff_t along_step;
  // What was drawn of the row beyond the image on that side, as 1 / depth.
  int beyond_count = 0;
  const float* beyond = nullptr;  ///< of the outermost pixel
  std::ptrdiff_t beyond_step = 0;
};

/// The minimum that runs along a row.
class Horizon {
 public:
  explicit Horizon(const View& view)
      : b_(view.baseline < 0.0f ? -view.baseline : view.baseline),
        smooth_(kSmooth_px * view.pixel),
        margin_(kMargin_px * view.pixel) {}

  void lower(float to) { least_ = to < least_ ? to : least_; }
  float least() const { return least_; }

  /// What the other eye sees of a sample; infinity where there is nothing.
  float seen(float direction, float nearness) const {
    return nearness > 0.0f ? direction - b_ * nearness : kInfinity;
  }

  /// Before a sample: what ends between the last one and it.
  void end(float nearness) {
    const float jump = b_ * (nearness > before_w_ ? nearness - before_w_ : before_w_ - nearness);
    if (jump > smooth_ || !(nearness > 0.0f)) lower(before_ - margin_);
  }

  /// After it.
  void pass(float seen, float nearness) {
    lower(seen);
    before_ = seen;
    before_w_ = nearness;
  }

 private:
  float b_, smooth_, margin_;
  float least_ = kInfinity, before_ = kInfinity, before_w_ = 0.0f;
};

template <class Report>
inline void find_doubts(const View& view, const Row& row, const Output& out, const Report& report) {
  const float b = view.baseline < 0.0f ? -view.baseline : view.baseline;
  const float sign = view.baseline < 0.0f ? -1.0f : 1.0f;
  const float rounding = kRounding_px * view.pixel;
  const float first = sign * row.along[0];  // directions fall from here
  const float outermost = first + float(row.beyond_count) * view.pixel;
  Horizon horizon(view);
  // What lies outside of all may hide, as near as the nearest of it.
  if (view.border_nearness > 0.0f) horizon.lower(outermost - b * view.border_nearness);
  for (int k = 0; k < row.beyond_count; ++k) {
    const float w = row.beyond[k * row.beyond_step];
    horizon.end(w);
    horizon.pass(horizon.seen(outermost - float(k) * view.pixel, w), w);
  }
  for (int k = 0; k < row.count; ++k) {
    const std::size_t at = row.first + std::size_t(k * row.step);
    const float z = out.z[at], w = z > 0.0f ? 1.0f / z : 0.0f;
    const float seen = horizon.seen(sign * row.along[k * row.along_step], w);
    horizon.end(w);
    if (out.miss[at] == kCounts && seen >= horizon.least() - rounding) report(k, at);
    horizon.pass(seen, w);
  }
}

/// What a canvas holds beyond the image on the side of the other eye.
inline void add_beyond(const View& view, const Window& frame, const Canvas& canvas, int line,
                       Row& row) {
  const Window& c = canvas.frame;
  const std::ptrdiff_t width = c.right - c.left;
  const bool after = view.baseline > 0.0f;  // in the order of the pixels
  if (view.baseline_along_rows) {
    row.beyond_count = after ? c.right - frame.right : frame.left - c.left;
    row.beyond = canvas.nearness + (frame.top + line - c.top) * width + (after ? width - 1 : 0);
    row.beyond_step = after ? -1 : 1;
  } else {
    row.beyond_count = after ? c.bottom - frame.bottom : frame.top - c.top;
    row.beyond = canvas.nearness + (frame.left + line - c.left) +
                 (after ? (c.bottom - c.top - 1) * width : 0);
    row.beyond_step = after ? -width : width;
  }
}

/// Takes from the samples of the frame that count those that the other eye does not see.
inline void occlude_image(const View& view, const Directions& d, const Window& frame,
                          const Canvas* canvas, const Output& out) {
  Doubts doubts(view, out);
  const int width = frame.right - frame.left, height = frame.bottom - frame.top;
  const bool rows = view.baseline_along_rows, forward = view.baseline < 0.0f;
  const int lines = rows ? height : width, count = rows ? width : height;
  const float* x = d.x + frame.left;
  const float* y = d.y + frame.top;
  for (int line = 0; line < lines; ++line) {
    const std::ptrdiff_t step = rows ? 1 : width;
    const std::size_t start = rows ? std::size_t(line) * std::size_t(width) : std::size_t(line);
    const int first = forward ? 0 : count - 1;
    const float* along = rows ? x : y;
    Row row{start + std::size_t(first) * std::size_t(step), forward ? step : -step, count,
            along + first, forward ? 1 : -1};
    if (canvas != nullptr) add_beyond(view, frame, *canvas, line, row);
    find_doubts(view, row, out, [&](int k, std::size_t at) {
      const int place = forward ? k : count - 1 - k;
      doubts.add(at, rows ? x[place] : x[line], rows ? y[line] : y[place]);
    });
  }
  doubts.trace();
}

void trace_image(const View& view, const Directions& directions, const Window& frame,
                 int tile_width, const Output& out) {
  if (tile_width >= 4)
    trace_tiles<4>(view, directions, frame, out);
  else if (tile_width == 2)
    trace_tiles<2>(view, directions, frame, out);
  else
    trace_tiles<1>(view, directions, frame, out);
  if (view.two_eyed && view.baseline != 0.0f) occlude_image(view, directions, frame, nullptr, out);
}
