#include "widgets/theme.hpp"

#include <QApplication>
#include <QPalette>
#include <QStyle>
#include <QStyleFactory>
#include <QVariant>
#include <QWidget>
#include <array>

namespace turnscan::studio {

namespace {

constexpr const char* kSheet = R"(
QToolTip { color: %text; background: %panel; border: 1px solid %line; padding: 4px; }
QMainWindow, QDialog { background: %window; }
QScrollArea, QWidget#panel_body { background: %panel; border: none; }
QWidget#panel { background: %panel; border-left: 1px solid %line; }
QWidget#view_panel { background: %panel; border-bottom: 1px solid %line; }
QWidget#tree_panel { background: %panel; border-right: 1px solid %line; }
QTabBar { background: %panel; font-weight: 600; }
QTabBar::tab { background: %panel; color: %quiet; padding: 8px 14px;
  border-bottom: 2px solid transparent; }
QTabBar::tab:hover { color: %text; }
QTabBar::tab:selected { color: %accent; border-bottom: 2px solid %accent; }
QTabBar::tab:focus { color: %text; border-bottom: 2px solid %text; }
QWidget#top_bar { background: %panel; border-bottom: 1px solid %line; }
QToolButton#mode { border: none; border-radius: 6px; padding: 7px 16px; color: %quiet;
  font-weight: 600; }
QToolButton#mode:hover { background: %window; color: %text; }
QToolButton#mode:checked { background: %accent; color: %accent_text; }
QToolButton#section { border: none; padding: 7px 4px; font-weight: 600; color: %text;
  text-align: left; }
QToolButton#section[nested="true"] { font-weight: 500; }
QToolButton#section:hover { color: %accent; }
QFrame#rule { background: %line; max-height: 1px; border: none; }
QLabel#quiet { color: %quiet; }
QLabel#title { font-size: 15px; font-weight: 600; }
QLabel#field_error, QLabel#error { color: %error; }
QLabel#error { padding: 7px 9px; border: 1px solid %error; border-radius: 5px; }
QLineEdit, QPlainTextEdit, QTableWidget, QListWidget, QTreeWidget {
  background: %field; border: 1px solid %line; border-radius: 5px; }
QLineEdit { padding: 3px 7px; min-height: 20px; }
QLineEdit:focus, QTableWidget:focus, QTreeWidget:focus, QListWidget:focus,
QPlainTextEdit:focus { border: 1px solid %accent; }
QLineEdit[invalid="true"] { border: 1px solid %error; }
QPushButton, QToolButton#tool { background: %field; color: %text; border: 1px solid %line;
  border-radius: 5px; padding: 6px 12px; min-height: 18px; }
QToolButton#tool { padding: 6px 9px; }
QToolButton#tool[menu="true"] { padding-right: 24px; }
QToolButton#tool::menu-indicator { image: url(:/studio/icons/arrow.png); width: 12px; height: 12px;
  subcontrol-origin: border; subcontrol-position: right center; right: 7px; }
QComboBox { background: %field; border: 1px solid %line; border-radius: 5px; padding: 3px 7px;
  min-height: 20px; }
QComboBox:hover, QComboBox:focus { border-color: %accent; }
QComboBox:disabled { color: %faint; background: %panel; }
QComboBox::drop-down { border: none; width: 24px; }
QComboBox::down-arrow { image: url(:/studio/icons/arrow.png); width: 12px; height: 12px; }
QComboBox QAbstractItemView { background: %field; border: 1px solid %line; padding: 3px;
  selection-background-color: %accent; selection-color: %accent_text; outline: none; }
QComboBox QAbstractItemView::item { min-height: 24px; padding: 0 6px; }
QComboBox QAbstractItemView::item:selected { background: %accent; color: %accent_text; }
QCheckBox { spacing: 7px; }
QCheckBox::indicator, QTreeView::indicator { width: 14px; height: 14px; border: 1px solid %edge;
  border-radius: 4px; background: %field; }
QCheckBox::indicator:checked, QTreeView::indicator:checked { background: %accent;
  border-color: %accent; image: url(:/studio/icons/check.png); }
QCheckBox::indicator:disabled { border-color: %line; background: %panel; }
QListWidget, QTreeWidget { padding: 3px; outline: none; }
QTableWidget::item { padding: 0 5px; }
QListWidget::item, QTreeWidget::item { min-height: 24px; }
QListWidget::item { border-radius: 4px; }
QListWidget::item { padding-left: 5px; }
QListWidget::item:selected, QTreeWidget::item:selected { background: %accent;
  color: %accent_text; }
QPushButton:hover, QToolButton#tool:hover { border-color: %accent; }
QPushButton:pressed, QPushButton:checked, QToolButton#tool:pressed, QToolButton#tool:checked {
  background: %accent; color: %accent_text; border-color: %accent; }
QPushButton:disabled, QToolButton#tool:disabled { color: %faint; background: %panel; }
QPushButton#primary { background: %accent; color: %accent_text; border-color: %accent;
  font-weight: 600; padding: 6px 14px; }
QPushButton#primary:disabled { background: %line; border-color: %line; color: %quiet; }
QPushButton#secondary { padding: 6px 14px; }
QPushButton#record { background: %error; color: %accent_text; border-color: %error; font-weight: 600;
  padding: 7px 14px; }
QPushButton#record:disabled { background: %line; border-color: %line; color: %quiet; }
QPushButton, QToolButton, QCheckBox, QSlider { outline: none; }
QPushButton:focus, QToolButton#tool:focus { border: 2px solid %accent; padding: 5px 11px; }
QToolButton#tool:focus { padding: 5px 8px; }
QPushButton#primary:focus, QPushButton#record:focus { border: 2px solid %text; padding: 5px 13px; }
QPushButton#record:focus { padding: 6px 13px; }
QToolButton#mode:focus { border: 2px solid %text; padding: 5px 14px; }
QToolButton#section:focus, QCheckBox:focus { color: %accent; text-decoration: underline; }
QCheckBox::indicator:focus { border: 2px solid %text; width: 12px; height: 12px; }
QComboBox:focus { border: 2px solid %accent; padding: 2px 6px; }
QLabel#platter_chip { padding: 5px 9px; border-radius: 5px; border: 1px solid %line; }
QLabel#platter_chip[grade="good"], QLabel#platter_chip[grade="fair"],
QLabel#platter_chip[grade="bad"] { color: #101010; border: none; }
QLabel#platter_chip[grade="good"] { background: #009e73; }
QLabel#platter_chip[grade="fair"] { background: #e69f00; }
QLabel#platter_chip[grade="bad"] { background: #d55e00; }
QToolButton#dismiss { border: none; color: %error; padding: 0; }
QHeaderView::section { background: %panel; color: %quiet; border: none;
  border-bottom: 1px solid %line; padding: 4px 6px; }
QTableWidget, QTreeWidget { gridline-color: %line; selection-background-color: %accent;
  selection-color: %accent_text; }
QStatusBar QLabel { padding-left: 6px; }
QStatusBar { background: %panel; color: %quiet; border-top: 1px solid %line; }
QStatusBar::item { border: none; }
QProgressBar { border: 1px solid %line; border-radius: 5px; background: %field; color: %text;
  text-align: center; max-height: 16px; }
QProgressBar::chunk { background: %accent; border-radius: 4px; }
QMenu { background: %panel; color: %text; border: 1px solid %line; padding: 4px; }
QMenu::item { padding: 5px 26px 5px 18px; border-radius: 4px; }
QMenu::item:selected { background: %accent; color: %accent_text; }
QMenu::item:disabled { color: %faint; }
QMenu::separator { height: 1px; background: %line; margin: 4px 8px; }
QMenuBar { background: %panel; color: %text; border-bottom: 1px solid %line; }
QMenuBar::item { padding: 5px 10px; }
QMenuBar::item:selected { background: %window; }
QSlider::groove:horizontal { height: 4px; background: %line; border-radius: 2px; }
QSlider::handle:horizontal { width: 14px; height: 14px; margin: -5px 0; border-radius: 7px;
  background: %accent; }
QSlider[automatic="true"]::handle:horizontal { background: %line; }
QSlider::handle:horizontal:focus { border: 2px solid %text; width: 12px; height: 12px;
  margin: -6px 0; border-radius: 8px; }
QScrollBar:vertical { background: transparent; width: 10px; margin: 0; }
QScrollBar::handle:vertical { background: %line; border-radius: 5px; min-height: 24px; }
QScrollBar::add-line, QScrollBar::sub-line { height: 0; width: 0; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 0; }
QScrollBar::handle:horizontal { background: %line; border-radius: 5px; min-width: 24px; }
)";

QColor mixed(const QColor& a, const QColor& b, double share) {
  return QColor::fromRgbF(a.redF() + share * (b.redF() - a.redF()),
                          a.greenF() + share * (b.greenF() - a.greenF()),
                          a.blueF() + share * (b.blueF() - a.blueF()));
}

QString sheet_of(const Theme& t) {
  QString sheet = QString::fromLatin1(kSheet);
  // Longer names first: %accent is a part of %accent_text.
  sheet.replace("%accent_text", t.accent_text.name());
  sheet.replace("%accent", t.accent.name());
  sheet.replace("%window", t.window.name());
  sheet.replace("%panel", t.panel.name());
  sheet.replace("%field", t.field.name());
  sheet.replace("%quiet", t.quiet_text.name());
  sheet.replace("%edge", mixed(t.line, t.text, 0.35).name());
  sheet.replace("%faint", mixed(t.quiet_text, t.panel, 0.45).name());
  sheet.replace("%text", t.text.name());
  sheet.replace("%line", t.line.name());
  sheet.replace("%error", t.error.name());
  return sheet;
}

QPalette palette_of(const Theme& t) {
  QPalette p;
  p.setColor(QPalette::Window, t.panel);
  p.setColor(QPalette::WindowText, t.text);
  p.setColor(QPalette::Base, t.field);
  p.setColor(QPalette::AlternateBase, t.window);
  p.setColor(QPalette::Text, t.text);
  p.setColor(QPalette::Button, t.panel);
  p.setColor(QPalette::ButtonText, t.text);
  p.setColor(QPalette::ToolTipBase, t.panel);
  p.setColor(QPalette::ToolTipText, t.text);
  p.setColor(QPalette::Highlight, t.accent);
  p.setColor(QPalette::HighlightedText, t.accent_text);
  p.setColor(QPalette::Link, t.accent);
  p.setColor(QPalette::PlaceholderText, t.quiet_text);
  const QColor faint = mixed(t.quiet_text, t.panel, 0.45);
  p.setColor(QPalette::Disabled, QPalette::Text, faint);
  p.setColor(QPalette::Disabled, QPalette::WindowText, faint);
  p.setColor(QPalette::Disabled, QPalette::ButtonText, faint);
  return p;
}

}  // namespace

const Theme& light_theme() {
  static const Theme theme{false,
                           QColor(0xeef1f4),
                           QColor(0xf8f9fb),
                           QColor(0xffffff),
                           QColor(0x1d2630),
                           QColor(0x596470),
                           QColor(0xd5dbe1),
                           QColor(0x12708f),
                           QColor(0xffffff),
                           QColor(0xb3261e),
                           QColor(0x1f7a46),
                           QColor(0xfbfcfd),
                           QColor(0xd9e0e7)};
  return theme;
}

const Theme& dark_theme() {
  static const Theme theme{true,
                           QColor(0x15191e),
                           QColor(0x1f242a),
                           QColor(0x272d34),
                           QColor(0xe4e8ec),
                           QColor(0x95a0ab),
                           QColor(0x3a424b),
                           QColor(0x3aa3c4),
                           QColor(0x08181e),
                           QColor(0xf2827a),
                           QColor(0x67c98f),
                           QColor(0x3b444e),
                           QColor(0x191d22)};
  return theme;
}

void apply_theme(QApplication& app, const Theme& theme) {
  app.setStyle(QStyleFactory::create("Fusion"));
  app.setPalette(palette_of(theme));
  app.setStyleSheet(sheet_of(theme));
}

void set_style_property(QWidget& widget, const char* name, const QVariant& value) {
  if (widget.property(name) == value) return;
  widget.setProperty(name, value);
  widget.style()->unpolish(&widget);
  widget.style()->polish(&widget);
}

QColor model_color(int number) {
  static const std::array<QRgb, 10> colors{0xb9c4cf, 0xd9a066, 0x7fb3d5, 0x8fbf87, 0xc78fb8,
                                           0xd8c46c, 0x6fbfb2, 0xd08c7c, 0x9a9bd0, 0xa9a9a9};
  return QColor(colors[std::size_t(number < 0 ? 0 : number) % colors.size()]);
}

}  // namespace turnscan::studio
