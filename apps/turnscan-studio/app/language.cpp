#include "app/language.hpp"

#include <QCoreApplication>
#include <QFile>
#include <QLibraryInfo>
#include <QLocale>
#include <QSettings>
#include <QTranslator>
#include <algorithm>

namespace turnscan::studio {

namespace {

constexpr const char* kSetting = "window/language";

QString file_of(const QString& code) { return QString(":/studio/i18n/studio_%1.qm").arg(code); }

bool is_known(const QString& code) {
  const auto all = languages();
  return std::any_of(all.begin(), all.end(), [&](const Language& l) { return l.code == code; });
}

}  // namespace

std::vector<Language> languages() {
  std::vector<Language> out{{"en", "English"}};
  const Language translated[] = {{"es", QString::fromUtf8("Español")},
                                 {"de", "Deutsch"},
                                 {"fr", QString::fromUtf8("Français")}};
  for (const Language& each : translated)
    if (QFile::exists(file_of(each.code))) out.push_back(each);
  return out;
}

QString chosen_language() {
  const QString code = QSettings().value(kSetting).toString();
  return is_known(code) ? code : QString();
}

void choose_language(const QString& code) { QSettings().setValue(kSetting, code); }

QString shown_language() {
  if (const QString code = chosen_language(); !code.isEmpty()) return code;
  const QString system = QLocale::system().name().section('_', 0, 0);
  return is_known(system) ? system : QString("en");
}

void install_language(QCoreApplication& app, const QString& code) {
  for (QTranslator* old : app.findChildren<QTranslator*>("studio_language")) delete old;
  if (code == "en") return;
  const auto install = [](QTranslator* translator, bool loaded) {
    translator->setObjectName("studio_language");
    if (loaded) {
      QCoreApplication::installTranslator(translator);
    } else {
      delete translator;
    }
  };
  // Translates Qt's own dialogs, if its translations are installed.
  auto* qt = new QTranslator(&app);
  install(qt, qt->load("qtbase_" + code, QLibraryInfo::location(QLibraryInfo::TranslationsPath)));
  auto* own = new QTranslator(&app);
  install(own, own->load(file_of(code)));
}

}  // namespace turnscan::studio
