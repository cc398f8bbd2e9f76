#pragma once
// Building blocks of the panels.

#include <QLabel>
#include <QWidget>

class QPushButton;
class QScrollArea;
class QToolButton;
class QVBoxLayout;

namespace turnscan::studio {

/// A titled part of a panel that can be folded.
class Section : public QWidget {
  Q_OBJECT
 public:
  enum Level { kTop, kNested };  ///< a nested one is indented and has no rule below it

  Section(const QString& title, bool open, QWidget* parent = nullptr, Level level = kTop);
  QVBoxLayout* body() const { return body_; }
  void set_open(bool open);
  bool is_open() const;

 private:
  QToolButton* header_;
  QWidget* content_;
  QVBoxLayout* body_;
};

/// An error where it belongs, and in the messages; hidden without text.
class MessageLabel : public QLabel {
 public:
  explicit MessageLabel(QWidget* parent = nullptr);
  void show_text(const QString& text);
  /// On a line below what is shown.
  void add_text(const QString& text);
};

/// A paragraph of several lines, of which a panel shows all.
class ParagraphLabel : public QLabel {
 public:
  explicit ParagraphLabel(QWidget* parent = nullptr);
  void show_text(const QString& text);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void fit();
  void make_room();
};

/// Text that explains; wraps and stays in the background.
QLabel* quiet_label(const QString& text, QWidget* parent = nullptr);
QPushButton* button(const QString& text, const QString& tip, QWidget* parent = nullptr);
QPushButton* primary_button(const QString& text, const QString& tip, QWidget* parent = nullptr);
QToolButton* tool_button(const QString& text, const QString& tip, QWidget* parent = nullptr);
/// A vertical layout within a scroll area, as wide as the panel.
QVBoxLayout* scrolled_body(QScrollArea* area);

}  // namespace turnscan::studio
