// What the page says. Texts of the program itself (verdict, advice, errors) are English.

const en = {
  language: 'Language', device: 'Sensor', result: 'The model', files: 'Download', reasons: 'Verdict', scans: 'Scans',
  placeTitle: 'Place the object', place: 'Set it on the middle of the turntable, let the table turn, then press Start.',
  start: 'Start', prepareTitle: 'Getting ready', prepare: 'The sensor is opened and the table is looked for.',
  waitTitle: 'Waiting for an object', wait: 'Set it on the middle of the turntable.',
  recordTitle: 'Recording', record: '{0} frames. Do not touch the table.',
  computeTitle: 'Computing the model', compute: 'The object may be taken away.', left: 'About {0} s left.',
  askTitle: 'Turn it over?', turned: 'It lies like this: go on', done: 'Done',
  doneTitle: 'The model is ready', doneText: 'Look at it below, or scan another object.', another: 'Scan another object',
  recordedTitle: 'Recorded', recordedText: 'The model can be computed below, or elsewhere.',
  failedTitle: 'That did not work', failed: 'What was recorded is kept.', cancelledTitle: 'Cancelled', again: 'Try again',
  cancel: 'Cancel', viewerTitle: 'Somebody else operates the turntable', take: 'Operate the turntable',
  lost: 'The server does not answer. This page tries again.', live: 'What the sensor sees', surface: 'What was seen of it so far',
  advice: 'How to lay the object', model: 'The model in 3D', modelHelp: 'Turn it with a finger, the mouse or the arrow keys; zoom with two fingers or + and −.',
  noModel: 'This browser cannot draw the model in 3D.', green: 'Good', amber: 'Good, with reservations', red: 'Not good',
  open: 'Report', reconstruct: 'Compute the model', unfinishedText: 'It was not finished.', resume: 'Go on recording', delete: 'Delete this scan', deleteIt: 'Delete', keep: 'Keep it',
  deleteText: 'The recording and everything made of it will be gone.',
  running: 'running', unfinished: 'not finished', recorded: 'recorded', done_: 'done', damaged: 'damaged',
  good: 'good', fair: 'fair', bad: 'bad'
};
const es = {
  language: 'Idioma', device: 'Sensor', result: 'El modelo', files: 'Descargar', reasons: 'Valoración', scans: 'Escaneos',
  placeTitle: 'Coloque el objeto', place: 'Póngalo en el centro del plato, deje que gire y pulse Empezar.',
  start: 'Empezar', prepareTitle: 'Preparando', prepare: 'Se abre el sensor y se busca el plato.',
  waitTitle: 'Esperando un objeto', wait: 'Póngalo en el centro del plato.',
  recordTitle: 'Grabando', record: '{0} imágenes. No toque el plato.',
  computeTitle: 'Calculando el modelo', compute: 'Ya puede retirar el objeto.', left: 'Faltan unos {0} s.',
  askTitle: '¿Darle la vuelta?', turned: 'Ya está así: seguir', done: 'Terminar',
  doneTitle: 'El modelo está listo', doneText: 'Véalo abajo o escanee otro objeto.', another: 'Escanear otro objeto',
  recordedTitle: 'Grabado', recordedText: 'El modelo se puede calcular abajo o en otro lugar.',
  failedTitle: 'No ha funcionado', failed: 'Lo grabado se conserva.', cancelledTitle: 'Cancelado', again: 'Intentar de nuevo',
  cancel: 'Cancelar', viewerTitle: 'Otra persona maneja el plato', take: 'Manejar el plato',
  lost: 'El servidor no responde. Esta página lo intenta de nuevo.', live: 'Lo que ve el sensor', surface: 'Lo que se ha visto de él',
  advice: 'Cómo colocar el objeto', model: 'El modelo en 3D', modelHelp: 'Gírelo con el dedo, el ratón o las flechas; amplíe con dos dedos o con + y −.',
  noModel: 'Este navegador no puede dibujar el modelo en 3D.', green: 'Bueno', amber: 'Bueno, con reservas', red: 'No es bueno',
  open: 'Informe', reconstruct: 'Calcular el modelo', unfinishedText: 'No se terminó.', resume: 'Seguir grabando', delete: 'Borrar este escaneo', deleteIt: 'Borrar', keep: 'Conservarlo',
  deleteText: 'Se perderán la grabación y todo lo que se hizo con ella.',
  running: 'en curso', unfinished: 'sin terminar', recorded: 'grabado', done_: 'listo', damaged: 'dañado',
  good: 'bien', fair: 'regular', bad: 'mal'
};
const de = {
  language: 'Sprache', device: 'Sensor', result: 'Das Modell', files: 'Herunterladen', reasons: 'Urteil', scans: 'Scans',
  placeTitle: 'Objekt aufstellen', place: 'Stellen Sie es auf die Mitte des Drehtellers, lassen Sie ihn drehen und drücken Sie Start.',
  start: 'Start', prepareTitle: 'Vorbereitung', prepare: 'Der Sensor wird geöffnet und der Drehteller gesucht.',
  waitTitle: 'Warten auf ein Objekt', wait: 'Stellen Sie es auf die Mitte des Drehtellers.',
  recordTitle: 'Aufnahme', record: '{0} Bilder. Bitte den Drehteller nicht berühren.',
  computeTitle: 'Das Modell wird berechnet', compute: 'Das Objekt kann weggenommen werden.', left: 'Noch etwa {0} s.',
  askTitle: 'Umdrehen?', turned: 'Es liegt so: weiter', done: 'Fertig',
  doneTitle: 'Das Modell ist fertig', doneText: 'Sehen Sie es unten an, oder scannen Sie ein weiteres Objekt.', another: 'Weiteres Objekt scannen',
  recordedTitle: 'Aufgenommen', recordedText: 'Das Modell kann unten berechnet werden, oder anderswo.',
  failedTitle: 'Das ging nicht', failed: 'Was aufgenommen wurde, bleibt erhalten.', cancelledTitle: 'Abgebrochen', again: 'Noch einmal versuchen',
  cancel: 'Abbrechen', viewerTitle: 'Jemand anderes bedient den Drehteller', take: 'Drehteller bedienen',
  lost: 'Der Server antwortet nicht. Diese Seite versucht es erneut.', live: 'Was der Sensor sieht', surface: 'Was davon schon gesehen wurde',
  advice: 'So soll das Objekt liegen', model: 'Das Modell in 3D', modelHelp: 'Drehen mit Finger, Maus oder Pfeiltasten; Zoomen mit zwei Fingern oder + und −.',
  noModel: 'Dieser Browser kann das Modell nicht in 3D zeichnen.', green: 'Gut', amber: 'Gut, mit Vorbehalt', red: 'Nicht gut',
  open: 'Bericht', reconstruct: 'Modell berechnen', unfinishedText: 'Nicht beendet.', resume: 'Aufnahme fortsetzen', delete: 'Diesen Scan löschen', deleteIt: 'Löschen', keep: 'Behalten',
  deleteText: 'Die Aufnahme und alles, was daraus entstand, gehen verloren.',
  running: 'läuft', unfinished: 'nicht beendet', recorded: 'aufgenommen', done_: 'fertig', damaged: 'beschädigt',
  good: 'gut', fair: 'mäßig', bad: 'schlecht'
};
const fr = {
  language: 'Langue', device: 'Capteur', result: 'Le modèle', files: 'Télécharger', reasons: 'Verdict', scans: 'Numérisations',
  placeTitle: 'Posez l’objet', place: 'Posez-le au milieu du plateau, laissez tourner le plateau et appuyez sur Démarrer.',
  start: 'Démarrer', prepareTitle: 'Préparation', prepare: 'Le capteur s’ouvre et le plateau est recherché.',
  waitTitle: 'En attente d’un objet', wait: 'Posez-le au milieu du plateau.',
  recordTitle: 'Enregistrement', record: '{0} images. Ne touchez pas le plateau.',
  computeTitle: 'Calcul du modèle', compute: 'L’objet peut être retiré.', left: 'Encore {0} s environ.',
  askTitle: 'Le retourner ?', turned: 'Il est posé ainsi : continuer', done: 'Terminer',
  doneTitle: 'Le modèle est prêt', doneText: 'Regardez-le ci-dessous ou numérisez un autre objet.', another: 'Numériser un autre objet',
  recordedTitle: 'Enregistré', recordedText: 'Le modèle peut être calculé ci-dessous, ou ailleurs.',
  failedTitle: 'Cela n’a pas marché', failed: 'Ce qui a été enregistré est conservé.', cancelledTitle: 'Annulé', again: 'Réessayer',
  cancel: 'Annuler', viewerTitle: 'Quelqu’un d’autre utilise le plateau', take: 'Utiliser le plateau',
  lost: 'Le serveur ne répond pas. Cette page réessaie.', live: 'Ce que voit le capteur', surface: 'Ce qui en a été vu',
  advice: 'Comment poser l’objet', model: 'Le modèle en 3D', modelHelp: 'Tournez-le du doigt, à la souris ou avec les flèches ; zoomez à deux doigts ou avec + et −.',
  noModel: 'Ce navigateur ne peut pas dessiner le modèle en 3D.', green: 'Bon', amber: 'Bon, avec réserves', red: 'Pas bon',
  open: 'Rapport', reconstruct: 'Calculer le modèle', unfinishedText: 'Inachevé.', resume: 'Reprendre l’enregistrement', delete: 'Supprimer cette numérisation', deleteIt: 'Supprimer', keep: 'Conserver',
  deleteText: 'L’enregistrement et tout ce qui en est issu seront perdus.',
  running: 'en cours', unfinished: 'inachevé', recorded: 'enregistré', done_: 'prêt', damaged: 'endommagé',
  good: 'bon', fair: 'moyen', bad: 'mauvais'
};

export const LANGUAGES = {en: 'English', es: 'Español', de: 'Deutsch', fr: 'Français'};
const TEXTS = {en, es, de, fr};

export function textsOf(language) {
  const table = TEXTS[language];
  return (key, ...values) => values.reduce((text, value, i) => text.replace(`{${i}}`, value), table[key]);
}
