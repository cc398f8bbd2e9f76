#include "widgets/text.hpp"

#include <QChar>
#include <QCoreApplication>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>

namespace turnscan::studio {

QString grouped(std::size_t number) {
  QString text = QString::number(number);
  for (int at = int(text.size()) - 3; at > 0; at -= 3) text.insert(at, QChar(0x202f));
  return text;
}

QString short_value(const QString& text) {
  static const QRegularExpression pattern("^([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)([a-z/%]*)$");
  const auto match = pattern.match(text);
  bool good = false;
  const double value = match.captured(1).toDouble(&good);
  if (!match.hasMatch() || !good || std::abs(value) >= 1e12) return text;
  QString number;
  if (value >= 1000.0) {
    number = grouped(std::size_t(std::llround(value)));
  } else if (std::abs(value) < 1e-3) {
    number = QString::number(value, 'g', 3);
  } else {
    const int before = int(std::floor(std::log10(std::abs(value)))) + 1;
    number = QString::number(value, 'f', std::max(0, 3 - before));
    if (number.contains('.')) {
      while (number.endsWith('0')) number.chop(1);
      if (number.endsWith('.')) number.chop(1);
    }
  }
  return match.captured(2).isEmpty() ? number : number + ' ' + match.captured(2);
}

QString translated(const QString& text) {
  return QCoreApplication::translate("Options", text.toUtf8().constData());
}

QString title_of(const std::string& name) {
  QString title = QString::fromStdString(name).replace('-', ' ');
  if (!title.isEmpty()) title[0] = title[0].toUpper();
  return title;
}

}  // namespace turnscan::studio
