// Values as colours. Viridis (S. van der Walt and N. Smith, 2015; CC0), and a diverging map from
// blue by white to red (after K. Moreland, 2009).

const MAPS = {
  viridis: [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142],
            [31, 158, 137], [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37]],
  diverging: [[33, 60, 154], [76, 112, 201], [132, 164, 227], [190, 208, 240], [238, 238, 236],
              [243, 202, 184], [226, 146, 120], [198, 84, 68], [160, 20, 38]],
  classes: [[204, 196, 184], [224, 120, 40]]
};
const UNKNOWN = [150, 150, 150];

function blended(map, fraction) {
  const colors = MAPS[map];
  const at = Math.min(1, Math.max(0, fraction)) * (colors.length - 1);
  const low = Math.min(Math.floor(at), colors.length - 2);
  return colors[low].map((c, i) => c + (at - low) * (colors[low + 1][i] - c));
}

// Red, green and blue from 0 to 1; grey where there is no value.
export function colorOf(field, value) {
  const rgb = Number.isNaN(value) ? UNKNOWN
    : blended(field.map, (value - field.from) / (field.to - field.from));
  return rgb.map((c) => c / 255);
}

// CSS colours at these fractions of a field's range.
export function gradient(field, fractions) {
  return fractions.map((f) => `rgb(${blended(field.map, f).map(Math.round).join(', ')})`);
}
