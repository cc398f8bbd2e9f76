#pragma once
// All messages of the program since it started, in all modes.

#include <QDateTime>
#include <QObject>
#include <QString>
#include <deque>

namespace turnscan::studio {

/// Errors and lines of the status bar, oldest first; the last kMax of them. Window's thread only.
class MessageLog : public QObject {
  Q_OBJECT
 public:
  static constexpr std::size_t kMax = 1000;
  struct Entry {
    QDateTime time;
    bool error = false;
    QString text;
  };

  const std::deque<Entry>& entries() const { return entries_; }
  /// A repetition of the last text is not added again.
  void add(const QString& text, bool error);
  /// One line per entry.
  QString text() const;

 Q_SIGNALS:
  void added();

 private:
  std::deque<Entry> entries_;
};

/// The program's log.
MessageLog& messages();

}  // namespace turnscan::studio
