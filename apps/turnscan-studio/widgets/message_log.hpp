#pragma once
// What the program has said since it started, in all modes.

#include <QDateTime>
#include <QObject>
#include <QString>
#include <deque>

namespace turnscan::studio {

/// Errors and lines of the status bar, oldest first; the last kMax of them. Thread of the window.
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
  /// The same text once more, right after itself, is not noted again.
  void add(const QString& text, bool error);
  /// A line for each entry.
  QString text() const;

 Q_SIGNALS:
  void added();

 private:
  std::deque<Entry> entries_;
};

/// That of the program.
MessageLog& messages();

}  // namespace turnscan::studio
