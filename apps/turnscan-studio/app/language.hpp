#pragma once
// Language of the window: English, or a translation included in this build.

#include <QString>
#include <QStringList>
#include <vector>

class QCoreApplication;

namespace turnscan::studio {

struct Language {
  QString code;  ///< ISO 639: "es"
  QString name;  ///< in the language itself: "Español"
};

/// English first, then the translations in this build.
std::vector<Language> languages();

/// The user's choice: a code of languages(), or empty for the system's language.
QString chosen_language();
void choose_language(const QString& code);

/// The code of the language in use: the user's choice, else the system's if it is one of
/// languages(), else English.
QString shown_language();

/// Translates texts created from now on. Untranslated texts stay English.
void install_language(QCoreApplication& app, const QString& code);

}  // namespace turnscan::studio
