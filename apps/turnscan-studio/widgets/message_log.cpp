#include "widgets/message_log.hpp"

namespace turnscan::studio {

void MessageLog::add(const QString& text, bool error) {
  if (text.isEmpty()) return;
  if (!entries_.empty() && entries_.back().text == text && entries_.back().error == error) return;
  entries_.push_back({QDateTime::currentDateTime(), error, text});
  if (entries_.size() > kMax) entries_.pop_front();
  Q_EMIT added();
}

QString MessageLog::text() const {
  QString out;
  for (const Entry& entry : entries_)
    out += QString("%1  %2%3\n")
               .arg(entry.time.toString("HH:mm:ss"), entry.error ? tr("Error: ") : QString(),
                    entry.text);
  return out;
}

MessageLog& messages() {
  static MessageLog log;
  return log;
}

}  // namespace turnscan::studio
