#include "widgets/text.hpp"

#include <QChar>

namespace turnscan::studio {

QString grouped(std::size_t number) {
  QString text = QString::number(number);
  for (int at = int(text.size()) - 3; at > 0; at -= 3) text.insert(at, QChar(0x202f));
  return text;
}

QString title_of(const std::string& name) {
  QString title = QString::fromStdString(name).replace('-', ' ');
  if (!title.isEmpty()) title[0] = title[0].toUpper();
  return title;
}

}  // namespace turnscan::studio
