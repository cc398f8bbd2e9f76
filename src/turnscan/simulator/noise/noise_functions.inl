// Elementary functions and random numbers of single precision, without branches: compilers turn
// loops over them into vector code. Part of noise_kernel.inl, in its anonymous namespace.

constexpr float kTwoPi = 6.28318531f;

inline float bits_to_float(std::uint32_t bits) { return __builtin_bit_cast(float, bits); }
inline std::uint32_t float_to_bits(float value) { return __builtin_bit_cast(std::uint32_t, value); }
inline float smaller(float a, float b) { return a < b ? a : b; }
inline float larger(float a, float b) { return a > b ? a : b; }
inline float absolute(float a) { return bits_to_float(float_to_bits(a) & 0x7fffffffu); }
/// For |x| < 2^31.
inline float rounded_down(float x) {
  const float whole = static_cast<float>(static_cast<std::int32_t>(x));
  return whole > x ? whole - 1.0f : whole;
}

/// A bijection of 32 bits (xor-shift-multiply; constants of C. Wellons' hash search, 2018).
inline std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

/// In (0, 1).
inline float uniform(std::uint32_t counter, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t h = mix(mix(counter + a) ^ b);
  return static_cast<float>(static_cast<std::int32_t>(h >> 9)) * 0x1p-23f + 0x1p-24f;
}

/// Natural logarithm of a positive normal number, to 3e-7 (series of the area tangent).
inline float logarithm(float x) {
  const std::uint32_t bits = float_to_bits(x);
  // The mantissa between sqrt(1/2) and sqrt(2).
  const std::uint32_t shifted = bits - 0x3f3504f3u;
  const float exponent = static_cast<float>(static_cast<std::int32_t>(shifted) >> 23);
  const float m = bits_to_float((shifted & 0x007fffffu) + 0x3f3504f3u);
  const float s = (m - 1.0f) / (m + 1.0f), q = s * s;
  const float series = 2.0f + q * (0.666668177f + q * (0.399748504f + q * 0.299243897f));
  return exponent * 0.693147181f + s * series;
}

/// 2^x for -126 < x < 127.
inline float power_of_two(float x) {
  const float whole = rounded_down(x), f = x - whole;
  const float series =
      1.0f + f * (0.693146944f +
                  f * (0.240230456f +
                       f * (0.0554806292f +
                            f * (0.00968418643f + f * (0.00123913318f + f * 0.000218657849f)))));
  const auto exponent = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole) + 127) << 23;
  return series * bits_to_float(exponent);
}

struct Turn {
  float cosine, sine;
};

/// Cosine and sine of a number of turns in [0, 1].
inline Turn turn(float turns) {
  const float quarters = rounded_down(4.0f * turns + 0.5f), r = 4.0f * turns - quarters, q = r * r;
  const float s =
      r * (1.57079637f +
           q * (-0.645964086f + q * (0.0796925798f + q * (-0.00468126638f + q * 0.000158206298f))));
  const float c =
      1.0f + q * (-1.23370051f + q * (0.253669202f + q * (-0.0208600704f + q * 0.000903628068f)));
  // Bits rather than choices: compilers would make them jumps.
  const auto n = static_cast<std::uint32_t>(static_cast<std::int32_t>(quarters));
  const std::uint32_t odd = 0u - (n & 1u), cb = float_to_bits(c), sb = float_to_bits(s);
  const std::uint32_t x = (sb & odd) | (cb & ~odd), y = (cb & odd) | (sb & ~odd);
  return {bits_to_float(x ^ (((n + 1u) & 2u) << 30)), bits_to_float(y ^ ((n & 2u) << 30))};
}

/// Direction of (x, y) in turns, in [0, 1); 0 for the zero vector.
inline float turns_of(float y, float x) {
  const float ax = absolute(x), ay = absolute(y);
  const float big = larger(ax, ay), small = smaller(ax, ay);
  const float t = small / (big > 0.0f ? big : 1.0f);
  const bool steep = t > 0.414213562f;
  const float r = steep ? (t - 1.0f) / (t + 1.0f) : t, q = r * r;
  const float series =
      1.0f + q * (-0.33332786f + q * (0.199740827f + q * (-0.138484895f + q * 0.0797629207f)));
  float angle = r * series + (steep ? 0.785398163f : 0.0f);
  angle = ay > ax ? 1.57079633f - angle : angle;
  angle = x < 0.0f ? 3.14159265f - angle : angle;
  angle = y < 0.0f ? kTwoPi - angle : angle;
  const float turns = angle * (1.0f / kTwoPi);
  return turns < 1.0f ? turns : 0.0f;
}

/// Two independent standard normals (Box and Muller 1958).
inline Turn normal_pair(Key key, std::uint32_t counter) {
  const float u = uniform(counter, key.a, key.b), v = uniform(counter, key.c, key.d);
  const float radius = __builtin_sqrtf(-2.0f * logarithm(u));
  const Turn t = turn(v);
  return {radius * t.cosine, radius * t.sine};
}
