// The Kinect v2 and its driver. Part of noise_kernel.inl, behind noise_functions.inl. Frequencies
// and the constants of the decoder are those of libfreenect2's depth processor.

/// Turns of the phase for each metre of half path: 2 f / c.
constexpr float kTurnsPerMetre[kFrequencies] = {
    2.0f * 80e6f / 299792458.0f, 2.0f * 16e6f / 299792458.0f, 2.0f * 120e6f / 299792458.0f};
/// The decoder multiplies each amplitude by this: the modulation's contrast is the inverse.
constexpr float kGain[kFrequencies] = {1.322581f, 1.0f, 1.612903f};
constexpr float kStepCosine[kSteps] = {1.0f, -0.5f, -0.5f};
constexpr float kStepSine[kSteps] = {0.0f, 0.866025404f, -0.866025404f};
constexpr float kLimit = 32704.0f;  ///< the largest value that the 11 bit code can say
constexpr int kDrawsPerPixel = 8;

void phasors(int n, const float* __restrict half_path, const float* __restrict amplitude,
             Phasors out) {
  for (int f = 0; f < kFrequencies; ++f) {
    float* __restrict re = out.re[f];
    float* __restrict im = out.im[f];
    const float scale = 1.0f / kGain[f], per_metre = kTurnsPerMetre[f];
    for (int i = 0; i < n; ++i) {
      const float turns = half_path[i] * per_metre;
      const Turn t = turn(turns - rounded_down(turns));
      re[i] = amplitude[i] * scale * t.cosine;
      im[i] = amplitude[i] * scale * t.sine;
    }
  }
}

/// What the sensor's 11 bit code keeps of a value: whole numbers up to 128, above that 7 bits
/// behind the leading one.
inline float coded(float v) {
  const float size = smaller(absolute(v), kLimit);
  const std::uint32_t bits = float_to_bits(size);
  const std::uint32_t whole =
      float_to_bits(static_cast<float>(static_cast<std::int32_t>(size + 0.5f)));
  const std::uint32_t rounded = (bits + 0x8000u) & 0xffff0000u;
  // All ones below 128. Bits rather than a choice: compilers would make it a jump.
  const auto small =
      static_cast<std::uint32_t>(static_cast<std::int32_t>(bits - 0x43000000u) >> 31);
  const std::uint32_t kept = (whole & small) | (rounded & ~small);
  return smaller(bits_to_float(kept), kLimit) * (v < 0.0f ? -1.0f : 1.0f);
}

inline float correlation(float re, float im, int step, float sigma, float normal) {
  return coded(re * kStepCosine[step] - im * kStepSine[step] + sigma * normal);
}

constexpr int kBlock = 128;

void fill_pairs(Key key, std::uint32_t first, int n, float* __restrict a, float* __restrict b) {
  for (int i = 0; i < n; ++i) {
    const Turn pair = normal_pair(key, first + static_cast<std::uint32_t>(i) * kDrawsPerPixel);
    a[i] = pair.cosine;
    b[i] = pair.sine;
  }
}

/// v0 to v2 hold standard normals before.
void correlate_block(int n, const float* __restrict re, const float* __restrict im,
                     const float* __restrict amplitude, CorrelationNoise noise,
                     float* __restrict v0, float* __restrict v1, float* __restrict v2) {
  const float base = noise.read * noise.read, relative2 = noise.relative * noise.relative;
  for (int i = 0; i < n; ++i) {
    const float power = re[i] * re[i] + im[i] * im[i];
    const float sigma = __builtin_sqrtf(base + noise.shot * amplitude[i] + relative2 * power);
    v0[i] = correlation(re[i], im[i], 0, sigma, v0[i]);
    v1[i] = correlation(re[i], im[i], 1, sigma, v1[i]);
    v2[i] = correlation(re[i], im[i], 2, sigma, v2[i]);
  }
}

void correlate(int n, Phasors light, const float* amplitude, Key key, std::uint32_t first,
               CorrelationNoise noise, float* const* correlations) {
  float unused[kBlock];
  for (int f = 0; f < kFrequencies; ++f) {
    float* const* v = correlations + kSteps * f;
    for (int begin = 0; begin < n; begin += kBlock) {
      const int size = n - begin < kBlock ? n - begin : kBlock;
      const std::uint32_t draw = (first + static_cast<std::uint32_t>(begin)) * kDrawsPerPixel +
                                 2u * static_cast<std::uint32_t>(f);
      fill_pairs(key, draw, size, v[0] + begin, v[1] + begin);
      fill_pairs(key, draw + 1u, size, v[2] + begin, unused);
      correlate_block(size, light.re[f] + begin, light.im[f] + begin, amplitude + begin, noise,
                      v[0] + begin, v[1] + begin, v[2] + begin);
    }
  }
}

void combine_one(int n, const float* __restrict v0, const float* __restrict v1,
                 const float* __restrict v2, float gain, float* __restrict re, float* __restrict im,
                 float* __restrict norm) {
  for (int i = 0; i < n; ++i) {
    const float a =
        (v0[i] * kStepCosine[0] + v1[i] * kStepCosine[1] + v2[i] * kStepCosine[2]) * gain;
    const float b = -(v0[i] * kStepSine[0] + v1[i] * kStepSine[1] + v2[i] * kStepSine[2]) * gain;
    const float most = larger(larger(absolute(v0[i]), absolute(v1[i])), absolute(v2[i]));
    const float keep = most < kLimit ? 1.0f : 0.0f;
    norm[i] = __builtin_sqrtf(a * a + b * b);
    re[i] = keep * a;
    im[i] = keep * b;
  }
}

void combine(int n, const float* const* correlations, Phasors out, float* const* norm) {
  for (int f = 0; f < kFrequencies; ++f) {
    const float* const* v = correlations + kSteps * f;
    combine_one(n, v[0], v[1], v[2], kGain[f], out.re[f], out.im[f], norm[f]);
  }
}

/// To the driver's unit of amplitude.
constexpr float kToAmplitude = 0.6666667f;
/// Squared length (amplitude 3) from which a phasor takes part in the bilateral filter.
constexpr float kBilateralFrom = (3.0f / kToAmplitude) * (3.0f / kToAmplitude);
constexpr float kBilateralSlope = -1.442695f * 5.0f * 1.442695f;  // exp(-1.44 * 5 x) = 2^(this * x)
constexpr float kBilateralMost = 2.5f;
constexpr float kCentre = 0.1195716f, kBeside = 0.1131098f, kCorner = 0.1069973f;

/// The pixel in the middle: its direction, and how the others are weighed.
struct Middle {
  float x, y, from, slope;
};

struct Weighed {
  float weights, re, im, unlike;
};

inline Weighed plus(const Weighed& sum, const Middle& middle, float share, float re, float im,
                    float norm) {
  const float scale = 1.0f / larger(norm, 1e-20f);
  const float apart = 0.5f * (1.0f - (middle.x * re + middle.y * im) * scale);
  const float counts = norm * norm >= middle.from ? 1.0f : 0.0f;
  const float weight = counts * share * power_of_two(middle.slope * apart);
  return {sum.weights + weight, sum.re + weight * re, sum.im + weight * im,
          sum.unlike + counts * apart};
}

void smooth_one(int n, int stride, const float* __restrict re, const float* __restrict im,
                const float* __restrict norm, float* __restrict out_re, float* __restrict out_im,
                float* __restrict unlike) {
  for (int i = 0; i < n; ++i) {
    const int up = i - stride, down = i + stride;
    const float self2 = norm[i] * norm[i], scale = 1.0f / larger(norm[i], 1e-20f);
    const float strong = self2 < kBilateralFrom ? 0.0f : 1.0f;
    const Middle middle{re[i] * scale, im[i] * scale, strong * kBilateralFrom,
                        strong * kBilateralSlope};
    // By hand: compilers turn the loop over pixels into vector code only without loops within.
    Weighed sum{};
    sum = plus(sum, middle, kCorner, re[up - 1], im[up - 1], norm[up - 1]);
    sum = plus(sum, middle, kBeside, re[up], im[up], norm[up]);
    sum = plus(sum, middle, kCorner, re[up + 1], im[up + 1], norm[up + 1]);
    sum = plus(sum, middle, kBeside, re[i - 1], im[i - 1], norm[i - 1]);
    sum = plus(sum, middle, kCentre, re[i], im[i], norm[i]);
    sum = plus(sum, middle, kBeside, re[i + 1], im[i + 1], norm[i + 1]);
    sum = plus(sum, middle, kCorner, re[down - 1], im[down - 1], norm[down - 1]);
    sum = plus(sum, middle, kBeside, re[down], im[down], norm[down]);
    sum = plus(sum, middle, kCorner, re[down + 1], im[down + 1], norm[down + 1]);
    const float by = sum.weights > 0.0f ? 1.0f / larger(sum.weights, 1e-20f) : 0.0f;
    out_re[i] = sum.re * by;
    out_im[i] = sum.im * by;
    unlike[i] = larger(unlike[i], sum.unlike);
  }
}

void smooth(int n, int stride, Phasors in, const float* const* norm, Phasors out, float* unlike) {
  for (int i = 0; i < n; ++i) unlike[i] = 0.0f;
  for (int f = 0; f < kFrequencies; ++f)
    smooth_one(n, stride, in.re[f], in.im[f], norm[f], out.re[f], out.im[f], unlike);
}

// The three frequencies repeat after 3, 15 and 2 units of c / 480 MHz, together after 30.
constexpr float kUnits[kFrequencies] = {3.0f, 15.0f, 2.0f};
/// Their direction, frequency by frequency, of unit length.
constexpr float kDirection[kFrequencies] = {0.551318f, 0.110264f, 0.826977f};
/// Half path for a mean of one turn: c / (2 * (80 + 16 + 120) MHz) * 3.
constexpr float kMetresPerTurn = 3.0f * 299792458.0f / (2.0f * 216e6f);
constexpr float kMinAmplitude = 3.0f, kMinSum = 10.0f;
constexpr float kMinDoubt = 0.3490659f, kMaxDoubt = 0.6108653f;
constexpr float kDoubtSlope = -0.5330578f, kDoubtOffset = 0.7694894f * 3.321928f;

struct Turns {
  float t[kFrequencies];
};

/// Whole turns, so that the three agree as well as they can.
inline Turns unwrapped(float p0, float p1, float p2) {
  const float a = p0 * kUnits[0], b = p1 * kUnits[1], c = p2 * kUnits[2];
  float fine = rounded_down((b - a) * (1.0f / 3.0f) + 0.5f) * 3.0f + a;
  // By how much it misses the third, of a period of 2: odd means that 15 units are missing.
  const float miss = 0.5f * absolute(fine - c);
  const float odd = 2.0f * (miss - rounded_down(miss));
  const float add = odd > 0.5f && odd < 1.5f ? 15.0f : 0.0f;
  fine += add;
  const float finest = rounded_down((fine - c) * 0.5f + 0.5f) * 2.0f + c;
  return {{fine * (1.0f / 3.0f), (b + add) * (1.0f / 15.0f), finest * 0.5f}};
}

/// Squared distance, in radians, of the three from a line through zero along kDirection.
inline float disagreement(const Turns& turns) {
  const float x = turns.t[0] * kTwoPi, y = turns.t[1] * kTwoPi, z = turns.t[2] * kTwoPi;
  const float cx = y * kDirection[2] - z * kDirection[1];
  const float cy = z * kDirection[0] - x * kDirection[2];
  const float cz = x * kDirection[1] - y * kDirection[0];
  return cx * cx + cy * cy + cz * cz;
}

void unwrap(int n, Phasors in, float* __restrict half_path, float* __restrict amplitude,
            std::uint8_t* __restrict verdict) {
  const float* __restrict re0 = in.re[0], * __restrict re1 = in.re[1], * __restrict re2 = in.re[2];
  const float* __restrict im0 = in.im[0], * __restrict im1 = in.im[1], * __restrict im2 = in.im[2];
  for (int i = 0; i < n; ++i) {
    const float a0 = __builtin_sqrtf(re0[i] * re0[i] + im0[i] * im0[i]) * kToAmplitude;
    const float a1 = __builtin_sqrtf(re1[i] * re1[i] + im1[i] * im1[i]) * kToAmplitude;
    const float a2 = __builtin_sqrtf(re2[i] * re2[i] + im2[i] * im2[i]) * kToAmplitude;
    const float least = smaller(smaller(a0, a1), a2), sum = a0 + a1 + a2;
    const Turns turns =
        unwrapped(turns_of(im0[i], re0[i]), turns_of(im1[i], re1[i]), turns_of(im2[i], re2[i]));
    const float mean = (turns.t[0] + turns.t[1] + turns.t[2]) * (1.0f / 3.0f);
    const float doubt =
        power_of_two(1.442695f * (logarithm(larger(least, 1e-6f)) * kDoubtSlope + kDoubtOffset));
    const float bound = smaller(larger(doubt, kMinDoubt), kMaxDoubt);
    const bool dark = !(least >= kMinAmplitude && sum >= kMinSum);
    const bool aliased = !(mean > 0.0f && disagreement(turns) <= bound * bound);
    amplitude[i] = sum;
    half_path[i] = dark || aliased ? 0.0f : mean * kMetresPerTurn;
    const int reason = aliased ? kAliased : kGood;
    verdict[i] = static_cast<std::uint8_t>(dark ? kDark : reason);
  }
}

void depth(int n, const float* __restrict half_path, DepthRays rays, Gate gate, float* __restrict z,
           std::uint8_t* __restrict verdict) {
  const float* __restrict per_range = rays.z_per_range;
  const float* __restrict along = rays.along_emitter;
  for (int i = 0; i < n; ++i) {
    // range + |range * ray - emitter| = 2 half_path, solved for the range.
    const float s = half_path[i];
    const float twice = 2.0f * s;
    const float below = 2.0f * (twice - along[i]);
    const float range = (twice * twice - rays.emitter2) / (below > 1e-6f ? below : 1.0f);
    const float here = s > 0.0f && below > 1e-6f ? larger(range * per_range[i], 0.0f) : 0.0f;
    z[i] = here;
    const int beyond = here > gate.far_m ? kFar : kGood;
    const int outside = here < gate.near_m ? kNear : beyond;
    verdict[i] = static_cast<std::uint8_t>(verdict[i] != kGood ? verdict[i] : outside);
  }
}

constexpr float kEdgeSpread = 0.05f, kEdgeLeastMean = 50.0f;
constexpr float kEdgeNear = 0.050f, kEdgeFar = 0.030f, kEdgeMost = 0.100f;  // metres

/// Sum, sum of squares, least and greatest of 3 x 3 pixels.
struct Around {
  float sum, squares, low, high;
};

inline Around plus(const Around& a, float here, float z, float amplitude) {
  return {a.sum + amplitude, a.squares + amplitude * amplitude, smaller(a.low, z > 0.0f ? z : here),
          larger(a.high, z)};
}

void edges(int n, int stride, const float* __restrict z, const float* __restrict amplitude,
           const float* __restrict unlike, std::uint8_t* __restrict verdict) {
  for (int i = 0; i < n; ++i) {
    const int up = i - stride, down = i + stride;
    const float here = z[i];
    Around a{0.0f, 0.0f, here, here};
    a = plus(a, here, z[up - 1], amplitude[up - 1]);
    a = plus(a, here, z[up], amplitude[up]);
    a = plus(a, here, z[up + 1], amplitude[up + 1]);
    a = plus(a, here, z[i - 1], amplitude[i - 1]);
    a = plus(a, here, z[i], amplitude[i]);
    a = plus(a, here, z[i + 1], amplitude[i + 1]);
    a = plus(a, here, z[down - 1], amplitude[down - 1]);
    a = plus(a, here, z[down], amplitude[down]);
    a = plus(a, here, z[down + 1], amplitude[down + 1]);
    const float variance = larger(a.squares * 9.0f - a.sum * a.sum, 0.0f);
    const float spread = __builtin_sqrtf(variance) * (1.0f / 9.0f);
    const float mean = larger(a.sum * (1.0f / 9.0f), kEdgeLeastMean);
    const float behind = here - a.low, before = a.high - here;
    const int between = (behind > kEdgeNear ? 1 : 0) & (before > kEdgeFar ? 1 : 0) &
                        (larger(behind, before) > kEdgeMost ? 1 : 0) &
                        (spread >= kEdgeSpread * mean ? 1 : 0);
    const int edge = (between | (unlike[i] >= kBilateralMost ? 1 : 0)) != 0 ? kEdge : kGood;
    verdict[i] = static_cast<std::uint8_t>(verdict[i] != kGood ? verdict[i] : edge);
  }
}
