#pragma once
// Building blocks of the panels.

#include <QLabel>
#include <QWidget>

class QPushButton;
class QScrollArea;
class QToolButton;
class QVBoxLayout;

namespace turnscan::studio {

/// A collapsible titled part of a panel.
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

/// An error message, also added to the message log; hidden without text, and by its cross.
class MessageLabel : public QLabel {
 public:
  explicit MessageLabel(QWidget* parent = nullptr);
  void show_text(const QString& text);
  /// Appends a line to the shown text.
  void add_text(const QString& text);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QToolButton* dismiss_;
};

/// A paragraph of several lines, which a panel shows completely.
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

/// Explanatory text in a subdued colour; wraps.
QLabel* quiet_label(const QString& text, QWidget* parent = nullptr);
QPushButton* button(const QString& text, const QString& tip, QWidget* parent = nullptr);
QPushButton* primary_button(const QString& text, const QString& tip, QWidget* parent = nullptr);
QToolButton* tool_button(const QString& text, const QString& tip, QWidget* parent = nullptr);
/// A vertical layout inside a scroll area, as wide as the panel.
QVBoxLayout* scrolled_body(QScrollArea* area);

}  // namespace turnscan::studio
