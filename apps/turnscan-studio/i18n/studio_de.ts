<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>MessageLabel</name>
    <message>
        <source>Dismiss the message</source>
        <translation>Meldung schließen</translation>
    </message>
</context>
<context>
    <name>Options</name>
    <message>
        <source>Aim height</source>
        <translation>Zielhöhe</translation>
    </message>
    <message>
        <source>Aim x</source>
        <translation>Ziel x</translation>
    </message>
    <message>
        <source>Aim z</source>
        <translation>Ziel z</translation>
    </message>
    <message>
        <source>Albedo</source>
        <translation>Albedo</translation>
    </message>
    <message>
        <source>Align</source>
        <translation>Ausrichten</translation>
    </message>
    <message>
        <source>Alpha</source>
        <translation>Alpha</translation>
    </message>
    <message>
        <source>Angles</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Average frames</source>
        <translation>Gemittelte Bilder</translation>
    </message>
    <message>
        <source>Average share</source>
        <translation>Mittelungsanteil</translation>
    </message>
    <message>
        <source>Azimuth</source>
        <translation>Azimut</translation>
    </message>
    <message>
        <source>Base</source>
        <translation>Standfläche</translation>
    </message>
    <message>
        <source>Border</source>
        <translation>Rand</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>Candidates</source>
        <translation>Kandidaten</translation>
    </message>
    <message>
        <source>Cloud outliers</source>
        <translation>Ausreißer der Wolke</translation>
    </message>
    <message>
        <source>Clutter</source>
        <translation>Gegenstände</translation>
    </message>
    <message>
        <source>Color files</source>
        <translation>Farbdateien</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>Colour drift</source>
        <translation>Belichtungsdrift</translation>
    </message>
    <message>
        <source>Colour fov</source>
        <translation>Farbkamera, Sichtfeld</translation>
    </message>
    <message>
        <source>Colour given shift</source>
        <translation>Farbkamera, Lagefehler</translation>
    </message>
    <message>
        <source>Colour given turn</source>
        <translation>Farbkamera, Drehfehler</translation>
    </message>
    <message>
        <source>Colour gloss</source>
        <translation>Glanz</translation>
    </message>
    <message>
        <source>Colour height</source>
        <translation>Farbbildhöhe</translation>
    </message>
    <message>
        <source>Colour lamp</source>
        <translation>Lampe</translation>
    </message>
    <message>
        <source>Colour lamp azimuth</source>
        <translation>Lampe, Azimut</translation>
    </message>
    <message>
        <source>Colour lamp elevation</source>
        <translation>Lampe, Elevation</translation>
    </message>
    <message>
        <source>Colour noise</source>
        <translation>Farbrauschen</translation>
    </message>
    <message>
        <source>Colour pan</source>
        <translation>Farbkamera, Schwenk</translation>
    </message>
    <message>
        <source>Colour tilt</source>
        <translation>Farbkamera, Neigung</translation>
    </message>
    <message>
        <source>Colour vignetting</source>
        <translation>Vignettierung</translation>
    </message>
    <message>
        <source>Colour white drift</source>
        <translation>Weißabgleichdrift</translation>
    </message>
    <message>
        <source>Colour width</source>
        <translation>Farbbildbreite</translation>
    </message>
    <message>
        <source>Colour x</source>
        <translation>Farbkamera x</translation>
    </message>
    <message>
        <source>Colour y</source>
        <translation>Farbkamera y</translation>
    </message>
    <message>
        <source>Colour z</source>
        <translation>Farbkamera z</translation>
    </message>
    <message>
        <source>Coverage cell</source>
        <translation>Abdeckungszelle</translation>
    </message>
    <message>
        <source>Coverage holes</source>
        <translation>Abdeckungslücken</translation>
    </message>
    <message>
        <source>Coverage thin</source>
        <translation>Dünne Abdeckung</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>Zuschnitt</translation>
    </message>
    <message>
        <source>Crop below</source>
        <translation>Zuschnitt unterhalb</translation>
    </message>
    <message>
        <source>Crop beyond</source>
        <translation>Zuschnitt außerhalb</translation>
    </message>
    <message>
        <source>Crop height</source>
        <translation>Zuschnitthöhe</translation>
    </message>
    <message>
        <source>Crop margin</source>
        <translation>Zuschnittabstand</translation>
    </message>
    <message>
        <source>Crop radius</source>
        <translation>Zuschnittradius</translation>
    </message>
    <message>
        <source>Cut plane</source>
        <translation>Schnittebene</translation>
    </message>
    <message>
        <source>Device timeout</source>
        <translation>Geräte-Timeout</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Dropped</source>
        <translation>Verlorene Bilder</translation>
    </message>
    <message>
        <source>Edge fattening</source>
        <translation>Kantenverdickung</translation>
    </message>
    <message>
        <source>Elevation</source>
        <translation>Elevation</translation>
    </message>
    <message>
        <source>Exposure</source>
        <translation>Belichtungszeit</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Anpassung</translation>
    </message>
    <message>
        <source>Fit iterations</source>
        <translation>Anpassung, Schritte</translation>
    </message>
    <message>
        <source>Fit reach</source>
        <translation>Anpassung, Reichweite</translation>
    </message>
    <message>
        <source>Foot</source>
        <translation>Fußhöhe</translation>
    </message>
    <message>
        <source>Fps</source>
        <translation>Bilder je Sekunde</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>Gauge ball</source>
        <translation>Prüfkugel</translation>
    </message>
    <message>
        <source>Halt</source>
        <translation>Halt</translation>
    </message>
    <message>
        <source>Halt at</source>
        <translation>Halt, Zeitpunkt</translation>
    </message>
    <message>
        <source>Hand</source>
        <translation>Hand</translation>
    </message>
    <message>
        <source>Hand at</source>
        <translation>Hand, Zeitpunkt</translation>
    </message>
    <message>
        <source>Hand direction</source>
        <translation>Hand, Richtung</translation>
    </message>
    <message>
        <source>Hand height</source>
        <translation>Hand, Höhe</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Hole size</source>
        <translation>Lochgröße</translation>
    </message>
    <message>
        <source>Holes</source>
        <translation>Löcher</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>Keep box</source>
        <translation>Quader behalten</translation>
    </message>
    <message>
        <source>Knock</source>
        <translation>Stoß</translation>
    </message>
    <message>
        <source>Knock at</source>
        <translation>Stoß, Zeitpunkt</translation>
    </message>
    <message>
        <source>Knock direction</source>
        <translation>Stoß, Richtung</translation>
    </message>
    <message>
        <source>Knock pan</source>
        <translation>Stoß, Schwenk</translation>
    </message>
    <message>
        <source>Knock tilt</source>
        <translation>Stoß, Neigung</translation>
    </message>
    <message>
        <source>Lean</source>
        <translation>Seitenneigung</translation>
    </message>
    <message>
        <source>Mark invented</source>
        <translation>Ergänztes markieren</translation>
    </message>
    <message>
        <source>Max error</source>
        <translation>Max. Fehler</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Min free</source>
        <translation>Min. frei (Bytes)</translation>
    </message>
    <message>
        <source>Min object share</source>
        <translation>Min. Objektanteil</translation>
    </message>
    <message>
        <source>Mixed pixels</source>
        <translation>Mischpixel</translation>
    </message>
    <message>
        <source>Mixed reach</source>
        <translation>Mischpixel, Reichweite</translation>
    </message>
    <message>
        <source>Motion angle sigma</source>
        <translation>Bewegung, Winkelsigma</translation>
    </message>
    <message>
        <source>Motion angles</source>
        <translation>Bewegung, Winkel</translation>
    </message>
    <message>
        <source>Motion keys</source>
        <translation>Bewegung, Schlüsselbilder</translation>
    </message>
    <message>
        <source>Motion table</source>
        <translation>Bewegung, Drehteller</translation>
    </message>
    <message>
        <source>Motor baud</source>
        <translation>Motor, Baudrate</translation>
    </message>
    <message>
        <source>Motor boot</source>
        <translation>Motor, Startzeit</translation>
    </message>
    <message>
        <source>Motor max speed</source>
        <translation>Motor, max. Tempo</translation>
    </message>
    <message>
        <source>Motor protocol</source>
        <translation>Motor, Protokoll</translation>
    </message>
    <message>
        <source>Motor reversed</source>
        <translation>Motor umgekehrt</translation>
    </message>
    <message>
        <source>Motor timeout</source>
        <translation>Motor-Timeout</translation>
    </message>
    <message>
        <source>Motor units</source>
        <translation>Motor, Einheiten</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>Noise window</source>
        <translation>Rauschfenster</translation>
    </message>
    <message>
        <source>Normal radius</source>
        <translation>Normalenradius</translation>
    </message>
    <message>
        <source>Object gap</source>
        <translation>Objektabstand</translation>
    </message>
    <message>
        <source>Object move</source>
        <translation>Objektverschiebung</translation>
    </message>
    <message>
        <source>Object move at</source>
        <translation>Verschiebung, Zeitpunkt</translation>
    </message>
    <message>
        <source>Object move direction</source>
        <translation>Verschiebung, Richtung</translation>
    </message>
    <message>
        <source>Object move tip</source>
        <translation>Verschiebung, Kippen</translation>
    </message>
    <message>
        <source>Object move turn</source>
        <translation>Verschiebung, Drehung</translation>
    </message>
    <message>
        <source>Object x</source>
        <translation>Objekt x</translation>
    </message>
    <message>
        <source>Object z</source>
        <translation>Objekt z</translation>
    </message>
    <message>
        <source>Only object</source>
        <translation>Nur Objekt</translation>
    </message>
    <message>
        <source>Outlier k</source>
        <translation>Ausreißer, Nachbarn</translation>
    </message>
    <message>
        <source>Outlier lambda</source>
        <translation>Ausreißer, Lambda</translation>
    </message>
    <message>
        <source>Outliers</source>
        <translation>Ausreißer</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Überlappung</translation>
    </message>
    <message>
        <source>Pass</source>
        <translation>Durchgang</translation>
    </message>
    <message>
        <source>Platter</source>
        <translation>Drehteller</translation>
    </message>
    <message>
        <source>Platter confidence</source>
        <translation>Drehteller, Konfidenz</translation>
    </message>
    <message>
        <source>Platter max radius</source>
        <translation>Drehteller, max. Radius</translation>
    </message>
    <message>
        <source>Platter min radius</source>
        <translation>Drehteller, min. Radius</translation>
    </message>
    <message>
        <source>Platter radius</source>
        <translation>Drehtellerradius</translation>
    </message>
    <message>
        <source>Platter rim</source>
        <translation>Drehtellerrand</translation>
    </message>
    <message>
        <source>Platter thickness</source>
        <translation>Drehtellerdicke</translation>
    </message>
    <message>
        <source>Poisson depth</source>
        <translation>Poisson-Tiefe</translation>
    </message>
    <message>
        <source>Poisson point weight</source>
        <translation>Poisson-Punktgewicht</translation>
    </message>
    <message>
        <source>Poisson samples</source>
        <translation>Poisson-Stichproben</translation>
    </message>
    <message>
        <source>Poisson scale</source>
        <translation>Poisson-Skalierung</translation>
    </message>
    <message>
        <source>Record queue</source>
        <translation>Aufnahme-Warteschlange</translation>
    </message>
    <message>
        <source>Record threads</source>
        <translation>Aufnahme-Threads</translation>
    </message>
    <message>
        <source>Refine</source>
        <translation>Verfeinern</translation>
    </message>
    <message>
        <source>Refine colour camera</source>
        <translation>Farbkamera verfeinern</translation>
    </message>
    <message>
        <source>Refine iterations</source>
        <translation>Verfeinerungsschritte</translation>
    </message>
    <message>
        <source>Refine radius</source>
        <translation>Verfeinerungsradius</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Reparieren</translation>
    </message>
    <message>
        <source>Ripple</source>
        <translation>Gleichlaufschwankung</translation>
    </message>
    <message>
        <source>Ripple cycles</source>
        <translation>Schwankungszyklen</translation>
    </message>
    <message>
        <source>Roll</source>
        <translation>Rollwinkel</translation>
    </message>
    <message>
        <source>Room</source>
        <translation>Umgebung</translation>
    </message>
    <message>
        <source>Runout</source>
        <translation>Rundlauffehler</translation>
    </message>
    <message>
        <source>Runout cycles</source>
        <translation>Rundlaufzyklen</translation>
    </message>
    <message>
        <source>Sample seed</source>
        <translation>Stichproben-Startwert</translation>
    </message>
    <message>
        <source>Samples</source>
        <translation>Stichproben</translation>
    </message>
    <message>
        <source>Scan colour</source>
        <translation>Farbe scannen</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>Sekunden</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Startwert</translation>
    </message>
    <message>
        <source>Settle</source>
        <translation>Beruhigungszeit</translation>
    </message>
    <message>
        <source>Sharpen</source>
        <translation>Schärfen</translation>
    </message>
    <message>
        <source>Slip</source>
        <translation>Schlupf</translation>
    </message>
    <message>
        <source>Slip at</source>
        <translation>Schlupf, Zeitpunkt</translation>
    </message>
    <message>
        <source>Smallest part</source>
        <translation>Kleinstes Teil</translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation>Glättung</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>Start delay</source>
        <translation>Anlaufverzögerung</translation>
    </message>
    <message>
        <source>Start ramp</source>
        <translation>Anlauframpe</translation>
    </message>
    <message>
        <source>Stop frames</source>
        <translation>Bilder je Halt</translation>
    </message>
    <message>
        <source>Stop ramp</source>
        <translation>Bremsrampe</translation>
    </message>
    <message>
        <source>Stops</source>
        <translation>Haltepunkte</translation>
    </message>
    <message>
        <source>Sub voxel line</source>
        <translation>Subvoxel-Linie</translation>
    </message>
    <message>
        <source>Sub voxels</source>
        <translation>Subvoxel</translation>
    </message>
    <message>
        <source>Table tilt</source>
        <translation>Drehtellerneigung</translation>
    </message>
    <message>
        <source>Table tilt direction</source>
        <translation>Neigungsrichtung</translation>
    </message>
    <message>
        <source>Table x</source>
        <translation>Drehteller x</translation>
    </message>
    <message>
        <source>Table y</source>
        <translation>Drehteller y</translation>
    </message>
    <message>
        <source>Table z</source>
        <translation>Drehteller z</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Textur</translation>
    </message>
    <message>
        <source>Texture size</source>
        <translation>Texturgröße</translation>
    </message>
    <message>
        <source>Thresholds</source>
        <translation>Schwellenwerte</translation>
    </message>
    <message>
        <source>Tip</source>
        <translation>Kippung</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>Toleranz</translation>
    </message>
    <message>
        <source>Travel</source>
        <translation>Verfahrweg</translation>
    </message>
    <message>
        <source>Travel along</source>
        <translation>Verfahrrichtung</translation>
    </message>
    <message>
        <source>Triangles</source>
        <translation>Dreiecke</translation>
    </message>
    <message>
        <source>Truncation</source>
        <translation>Trunkierung</translation>
    </message>
    <message>
        <source>Turns</source>
        <translation>Umdrehungen</translation>
    </message>
    <message>
        <source>Until stopped</source>
        <translation>Bis zum Stopp</translation>
    </message>
    <message>
        <source>Voxel grid</source>
        <translation>Voxelgitter</translation>
    </message>
    <message>
        <source>Voxel min points</source>
        <translation>Min. Punkte je Voxel</translation>
    </message>
    <message>
        <source>Voxel size</source>
        <translation>Voxelgröße</translation>
    </message>
    <message>
        <source>Warm up</source>
        <translation>Aufwärmen</translation>
    </message>
    <message>
        <source>Warm up time</source>
        <translation>Aufwärmzeit</translation>
    </message>
    <message>
        <source>Wiggling</source>
        <translation>Wiggling-Fehler</translation>
    </message>
    <message>
        <source>Wiggling period</source>
        <translation>Wiggling-Periode</translation>
    </message>
    <message>
        <source>Wobble</source>
        <translation>Taumeln</translation>
    </message>
    <message>
        <source>Wobble cycles</source>
        <translation>Taumelzyklen</translation>
    </message>
    <message>
        <source>Yaw</source>
        <translation>Drehung</translation>
    </message>
    <message>
        <source>Ball</source>
        <translation>Kugel</translation>
    </message>
    <message>
        <source>Ball bar</source>
        <translation>Kugelstab</translation>
    </message>
    <message>
        <source>Colour camera</source>
        <translation>Farbkamera</translation>
    </message>
    <message>
        <source>Covered</source>
        <translation>Abgedeckt</translation>
    </message>
    <message>
        <source>Cylinder</source>
        <translation>Zylinder</translation>
    </message>
    <message>
        <source>Doll</source>
        <translation>Puppe</translation>
    </message>
    <message>
        <source>Emitter blocked</source>
        <translation>Sender verdeckt</translation>
    </message>
    <message>
        <source>Grazing</source>
        <translation>Streifend</translation>
    </message>
    <message>
        <source>Letter a</source>
        <translation>Buchstabe A</translation>
    </message>
    <message>
        <source>Missed</source>
        <translation>Nicht abgedeckt</translation>
    </message>
    <message>
        <source>Motion of the turntable</source>
        <translation>Bewegung des Drehtellers</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keiner</translation>
    </message>
    <message>
        <source>Nothing</source>
        <translation>Nichts</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objekt</translation>
    </message>
    <message>
        <source>Out of view</source>
        <translation>Außerhalb des Sichtfelds</translation>
    </message>
    <message>
        <source>Place of the scanners</source>
        <translation>Position der Scanner</translation>
    </message>
    <message>
        <source>Plate</source>
        <translation>Platte</translation>
    </message>
    <message>
        <source>Receiver blocked</source>
        <translation>Empfänger verdeckt</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Rejected</source>
        <translation>Verworfen</translation>
    </message>
    <message>
        <source>Scorpion</source>
        <translation>Skorpion</translation>
    </message>
    <message>
        <source>Skull</source>
        <translation>Schädel</translation>
    </message>
    <message>
        <source>Thin</source>
        <translation>Dünn abgedeckt</translation>
    </message>
    <message>
        <source>Too dark</source>
        <translation>Zu dunkel</translation>
    </message>
    <message>
        <source>Too far</source>
        <translation>Zu weit</translation>
    </message>
    <message>
        <source>Too near</source>
        <translation>Zu nah</translation>
    </message>
    <message>
        <source>Turntable</source>
        <translation>Drehteller</translation>
    </message>
    <message>
        <source>Unreachable</source>
        <translation>Unerreichbar</translation>
    </message>
    <message>
        <source>Events during the recording</source>
        <translation>Ereignisse während der Aufnahme</translation>
    </message>
    <message>
        <source>Color quality</source>
        <translation>Farbqualität</translation>
    </message>
    <message>
        <source>Labelled cylinder</source>
        <translation>Zylinder mit Etikett</translation>
    </message>
    <message>
        <source>Action figure</source>
        <translation>Actionfigur</translation>
    </message>
    <message>
        <source>Aspect</source>
        <translation>Seitenverhältnis</translation>
    </message>
    <message>
        <source>Axial constant</source>
        <translation>Axial, konstant</translation>
    </message>
    <message>
        <source>Axial grazing</source>
        <translation>Axial, streifend</translation>
    </message>
    <message>
        <source>Axial grazing from</source>
        <translation>Axial, streifend ab</translation>
    </message>
    <message>
        <source>Axial grazing power</source>
        <translation>Axial, streifend, Potenz</translation>
    </message>
    <message>
        <source>Axial linear</source>
        <translation>Axial, linear</translation>
    </message>
    <message>
        <source>Axial linear from</source>
        <translation>Axial, linear ab</translation>
    </message>
    <message>
        <source>Axial quadratic</source>
        <translation>Axial, quadratisch</translation>
    </message>
    <message>
        <source>Axial quadratic at</source>
        <translation>Axial, quadratisch bei</translation>
    </message>
    <message>
        <source>Baseline</source>
        <translation>Basislinie</translation>
    </message>
    <message>
        <source>Baseline direction</source>
        <translation>Basislinie, Richtung</translation>
    </message>
    <message>
        <source>Bias</source>
        <translation>Tiefenversatz</translation>
    </message>
    <message>
        <source>Colour delay</source>
        <translation>Farbverzögerung</translation>
    </message>
    <message>
        <source>Colour jitter</source>
        <translation>Farbjitter</translation>
    </message>
    <message>
        <source>Columns</source>
        <translation>Spalten</translation>
    </message>
    <message>
        <source>Cx</source>
        <translation>Cx</translation>
    </message>
    <message>
        <source>Cy</source>
        <translation>Cy</translation>
    </message>
    <message>
        <source>Dark jitter</source>
        <translation>Dunkelsignal, Rauschen</translation>
    </message>
    <message>
        <source>Dark signal</source>
        <translation>Dunkelsignal</translation>
    </message>
    <message>
        <source>Depth unit</source>
        <translation>Tiefeneinheit</translation>
    </message>
    <message>
        <source>Disparity sigma</source>
        <translation>Disparität, Sigma</translation>
    </message>
    <message>
        <source>Disparity step</source>
        <translation>Disparität, Schritt</translation>
    </message>
    <message>
        <source>Drop from</source>
        <translation>Ausfall ab</translation>
    </message>
    <message>
        <source>Drop to</source>
        <translation>Ausfall bis</translation>
    </message>
    <message>
        <source>Far</source>
        <translation>Max. Entfernung</translation>
    </message>
    <message>
        <source>Footprint px</source>
        <translation>Messfleck, px</translation>
    </message>
    <message>
        <source>Fx</source>
        <translation>Fx</translation>
    </message>
    <message>
        <source>Fy</source>
        <translation>Fy</translation>
    </message>
    <message>
        <source>K1</source>
        <translation>K1</translation>
    </message>
    <message>
        <source>K2</source>
        <translation>K2</translation>
    </message>
    <message>
        <source>K3</source>
        <translation>K3</translation>
    </message>
    <message>
        <source>K4</source>
        <translation>K4</translation>
    </message>
    <message>
        <source>K5</source>
        <translation>K5</translation>
    </message>
    <message>
        <source>K6</source>
        <translation>K6</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Lateral grazing px</source>
        <translation>Lateral, streifend, px</translation>
    </message>
    <message>
        <source>Lateral length</source>
        <translation>Lateral, Länge</translation>
    </message>
    <message>
        <source>Lateral per metre</source>
        <translation>Lateral je Meter</translation>
    </message>
    <message>
        <source>Lateral px</source>
        <translation>Lateral, px</translation>
    </message>
    <message>
        <source>Line aperture</source>
        <translation>Linie, Apertur</translation>
    </message>
    <message>
        <source>Line blur</source>
        <translation>Linie, Unschärfe</translation>
    </message>
    <message>
        <source>Line contrast</source>
        <translation>Linie, Kontrast</translation>
    </message>
    <message>
        <source>Line exposure</source>
        <translation>Linie, Belichtung</translation>
    </message>
    <message>
        <source>Line focal</source>
        <translation>Linie, Brennweite</translation>
    </message>
    <message>
        <source>Line full well</source>
        <translation>Linie, Full-Well-Kapazität</translation>
    </message>
    <message>
        <source>Line read noise</source>
        <translation>Linie, Ausleserauschen</translation>
    </message>
    <message>
        <source>Line threshold</source>
        <translation>Linie, Schwelle</translation>
    </message>
    <message>
        <source>Line wavelength</source>
        <translation>Linie, Wellenlänge</translation>
    </message>
    <message>
        <source>Line width</source>
        <translation>Linie, Breite</translation>
    </message>
    <message>
        <source>Max incidence</source>
        <translation>Max. Einfallswinkel</translation>
    </message>
    <message>
        <source>Mixed rejection</source>
        <translation>Mischpixel, Verwerfung</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Near</source>
        <translation>Min. Entfernung</translation>
    </message>
    <message>
        <source>P1</source>
        <translation>P1</translation>
    </message>
    <message>
        <source>P2</source>
        <translation>P2</translation>
    </message>
    <message>
        <source>Pan</source>
        <translation>Schwenk nach rechts</translation>
    </message>
    <message>
        <source>Physics</source>
        <translation>Physik</translation>
    </message>
    <message>
        <source>Robed figure</source>
        <translation>Gewandfigur</translation>
    </message>
    <message>
        <source>Rows</source>
        <translation>Zeilen</translation>
    </message>
    <message>
        <source>Sensing</source>
        <translation>Messverfahren</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Neigung nach oben</translation>
    </message>
    <message>
        <source>Tof amplitude</source>
        <translation>ToF, Amplitude</translation>
    </message>
    <message>
        <source>Tof read noise</source>
        <translation>ToF, Ausleserauschen</translation>
    </message>
    <message>
        <source>Tof relative noise</source>
        <translation>ToF, relatives Rauschen</translation>
    </message>
    <message>
        <source>Tof shot noise</source>
        <translation>ToF, Schrotrauschen</translation>
    </message>
    <message>
        <source>Vertical fov</source>
        <translation>Vertikales Sichtfeld</translation>
    </message>
    <message>
        <source>Voxel grid in bounds</source>
        <translation>Voxelgitter im Hüllquader</translation>
    </message>
    <message>
        <source>Window agreement</source>
        <translation>Fenster, Übereinstimmung</translation>
    </message>
    <message>
        <source>Window dots</source>
        <translation>Fenster, Punkte</translation>
    </message>
    <message>
        <source>Window px</source>
        <translation>Fenster, px</translation>
    </message>
    <message>
        <source>Window share</source>
        <translation>Fenster, Anteil</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>Error, mm</source>
        <translation>Fehler, mm</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>median</source>
        <translation>Median</translation>
    </message>
    <message>
        <source>p95</source>
        <translation>p95</translation>
    </message>
    <message>
        <source>max</source>
        <translation>max.</translation>
    </message>
    <message>
        <source>Accuracy</source>
        <translation>Genauigkeit</translation>
    </message>
    <message>
        <source>Completeness</source>
        <translation>Vollständigkeit</translation>
    </message>
    <message>
        <source>Within</source>
        <translation>Innerhalb</translation>
    </message>
    <message>
        <source>precision</source>
        <translation>Präzision</translation>
    </message>
    <message>
        <source>recall</source>
        <translation>Trefferquote</translation>
    </message>
    <message>
        <source>distance to %1</source>
        <translation>Abstand zu %1</translation>
    </message>
    <message>
        <source>Millimetres</source>
        <translation>Millimeter</translation>
    </message>
    <message>
        <source>Centimetres</source>
        <translation>Zentimeter</translation>
    </message>
    <message>
        <source>Inches</source>
        <translation>Zoll</translation>
    </message>
    <message>
        <source>Metres</source>
        <translation>Meter</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
    <message>
        <source>Which unit?</source>
        <translation>Welche Einheit?</translation>
    </message>
    <message>
        <source>%1 does not say its unit. Read in %2 it is %3 large. In which unit is it?</source>
        <translation>%1 gibt keine Einheit an. In der Einheit %2 ist das Modell %3 groß. Welche Einheit ist richtig?</translation>
    </message>
    <message>
        <source>Distance to %1</source>
        <translation>Abstand zu %1</translation>
    </message>
    <message>
        <source> and more</source>
        <translation> und mehr</translation>
    </message>
    <message>
        <source>empty</source>
        <translation>leer</translation>
    </message>
    <message>
        <source>%1 vertices, %2 triangles in %3
%4
Area %5 cm²</source>
        <translation>%1 Eckpunkte, %2 Dreiecke in %3
%4
Fläche %5 cm²</translation>
    </message>
    <message>
        <source>1 piece</source>
        <translation>1 Teil</translation>
    </message>
    <message>
        <source>%1 pieces</source>
        <translation>%1 Teilen</translation>
    </message>
    <message>
        <source>
Texture of %1 × %2 texels</source>
        <translation>
Textur mit %1 × %2 Texeln</translation>
    </message>
    <message>
        <source>, volume %1 cm³</source>
        <translation>, Volumen %1 cm³</translation>
    </message>
    <message>
        <source>%1 points%2%3
%4</source>
        <translation>%1 Punkte%2%3
%4</translation>
    </message>
    <message>
        <source>, with normals</source>
        <translation>, mit Normalen</translation>
    </message>
    <message>
        <source>, with colours</source>
        <translation>, mit Farben</translation>
    </message>
    <message>
        <source>%1 triangles</source>
        <translation>%1 Dreiecke</translation>
    </message>
    <message>
        <source>%1 points</source>
        <translation>%1 Punkte</translation>
    </message>
    <message>
        <source>%1 frames</source>
        <translation>%1 Bilder</translation>
    </message>
    <message>
        <source>View of each place</source>
        <translation>Ansicht jeder Stelle</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>Zuschnitt</translation>
    </message>
    <message>
        <source>Statistical filter</source>
        <translation>Statistischer Filter</translation>
    </message>
    <message>
        <source>Merge</source>
        <translation>Zusammenführung</translation>
    </message>
    <message>
        <source>Voxelisation</source>
        <translation>Voxelisierung</translation>
    </message>
    <message>
        <source>Candidate points</source>
        <translation>Kandidatenpunkte</translation>
    </message>
    <message>
        <source>Objects</source>
        <translation>Objekte</translation>
    </message>
    <message>
        <source>Normals</source>
        <translation>Normalen</translation>
    </message>
    <message>
        <source>Refinement</source>
        <translation>Verfeinerung</translation>
    </message>
    <message>
        <source>Base</source>
        <translation>Standfläche</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>Volumetric mesh</source>
        <translation>Volumetrisches Netz</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>Nachbearbeitung</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Textur</translation>
    </message>
    <message>
        <source>Merge the frames</source>
        <translation>Bilder zusammenführen</translation>
    </message>
    <message>
        <source>Voxelise</source>
        <translation>Voxelisieren</translation>
    </message>
    <message>
        <source>Find candidates</source>
        <translation>Kandidaten suchen</translation>
    </message>
    <message>
        <source>Refine candidates</source>
        <translation>Kandidaten verfeinern</translation>
    </message>
    <message>
        <source>Oriented points</source>
        <translation>Orientierte Punkte</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>%1 mesh</source>
        <translation>Netz von %1</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>%1 was not joined: %2; its mesh is a model of its own</source>
        <translation>%1 wurde nicht verbunden: %2; sein Netz ist ein eigenes Modell</translation>
    </message>
    <message>
        <source>
Note: %1</source>
        <translation>
Hinweis: %1</translation>
    </message>
    <message>
        <source>%1 of %2 points were dropped</source>
        <translation>%1 von %2 Punkten wurden verworfen</translation>
    </message>
    <message>
        <source>filter of %1</source>
        <translation>Filter von %1</translation>
    </message>
    <message>
        <source>frame %1, from %2°: %3 %</source>
        <translation>Bild %1, aus %2°: %3 %</translation>
    </message>
    <message>
        <source>no view, filled: %1 %</source>
        <translation>keine Ansicht, aufgefüllt: %1 %</translation>
    </message>
    <message>
        <source>Above the plane</source>
        <translation>Über der Ebene</translation>
    </message>
    <message>
        <source>Seen from</source>
        <translation>Gesehen von</translation>
    </message>
    <message>
        <source>1 side</source>
        <translation>1 Seite</translation>
    </message>
    <message>
        <source>2 sides</source>
        <translation>2 Seiten</translation>
    </message>
    <message>
        <source>%1 or more</source>
        <translation>%1 oder mehr</translation>
    </message>
    <message>
        <source>nowhere yet</source>
        <translation>noch nirgends</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>Share of the surface</source>
        <translation>Anteil der Oberfläche</translation>
    </message>
    <message>
        <source>Samples per mm²</source>
        <translation>Messpunkte je mm²</translation>
    </message>
    <message>
        <source>Without a sample</source>
        <translation>Ohne Messpunkt</translation>
    </message>
    <message>
        <source>Has samples</source>
        <translation>Mit Messpunkten</translation>
    </message>
    <message>
        <source>Rig</source>
        <translation>Aufbau</translation>
    </message>
    <message>
        <source>View of a scanner</source>
        <translation>Sichtfeld eines Scanners</translation>
    </message>
    <message>
        <source>Emitter</source>
        <translation>Sender</translation>
    </message>
    <message>
        <source>Receiver</source>
        <translation>Empfänger</translation>
    </message>
    <message>
        <source>Rim, and the way it turns</source>
        <translation>Rand und Drehrichtung</translation>
    </message>
    <message>
        <source>Front	1</source>
        <translation>Vorne	1</translation>
    </message>
    <message>
        <source>Back	2</source>
        <translation>Hinten	2</translation>
    </message>
    <message>
        <source>Left	3</source>
        <translation>Links	3</translation>
    </message>
    <message>
        <source>Right	4</source>
        <translation>Rechts	4</translation>
    </message>
    <message>
        <source>Top	5</source>
        <translation>Oben	5</translation>
    </message>
    <message>
        <source>Bottom	6</source>
        <translation>Unten	6</translation>
    </message>
    <message>
        <source>Corner	7</source>
        <translation>Ecke	7</translation>
    </message>
    <message>
        <source>Reset camera</source>
        <translation>Kamera zurücksetzen</translation>
    </message>
    <message>
        <source>Show everything (Home)</source>
        <translation>Alles anzeigen (Pos1)</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Ansichten</translation>
    </message>
    <message>
        <source>Look from one side (1 to 7)</source>
        <translation>Von einer Seite betrachten (1 bis 7)</translation>
    </message>
    <message>
        <source>&lt;br&gt;From %1 to %2</source>
        <translation>&lt;br&gt;Von %1 bis %2</translation>
    </message>
    <message>
        <source>%1 s left</source>
        <translation>noch %1 s</translation>
    </message>
    <message>
        <source>%1 min %2 s left</source>
        <translation>noch %1 min %2 s</translation>
    </message>
    <message>
        <source>Quit?</source>
        <translation>Beenden?</translation>
    </message>
    <message>
        <source>Quit without saving</source>
        <translation>Ohne Speichern beenden</translation>
    </message>
    <message>
        <source>Stay</source>
        <translation>Nicht beenden</translation>
    </message>
    <message>
        <source>%1, %2 dropped</source>
        <translation>%1, %2 verloren</translation>
    </message>
    <message>
        <source>Probe</source>
        <translation>Prüfpunkt</translation>
    </message>
    <message>
        <source>The deviation from the reference at a place</source>
        <translation>Abweichung von der Referenz an einer Stelle</translation>
    </message>
    <message>
        <source>Click on a model whose deviations are shown</source>
        <translation>Auf ein Modell klicken, dessen Abweichungen gezeigt werden</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Distance between two places</source>
        <translation>Abstand zwischen zwei Stellen</translation>
    </message>
    <message>
        <source>Click two places on models</source>
        <translation>Zwei Stellen auf Modellen anklicken</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Angle at a corner between the directions to two places</source>
        <translation>Winkel an einem Scheitelpunkt zwischen den Richtungen zu zwei Stellen</translation>
    </message>
    <message>
        <source>Click a place, the corner, and another place</source>
        <translation>Eine Stelle, den Scheitelpunkt und eine weitere Stelle anklicken</translation>
    </message>
    <message>
        <source>Circle</source>
        <translation>Kreis</translation>
    </message>
    <message>
        <source>Diameter of the circle through three places</source>
        <translation>Durchmesser des Kreises durch drei Stellen</translation>
    </message>
    <message>
        <source>Click three places on the circle</source>
        <translation>Drei Stellen auf dem Kreis anklicken</translation>
    </message>
    <message>
        <source>Plane</source>
        <translation>Ebene</translation>
    </message>
    <message>
        <source>How flat the surface around a place is</source>
        <translation>Wie eben die Oberfläche um eine Stelle ist</translation>
    </message>
    <message>
        <source>Click on a flat part of the selected model</source>
        <translation>Auf eine ebene Stelle des ausgewählten Modells klicken</translation>
    </message>
    <message>
        <source>Thickness</source>
        <translation>Wandstärke</translation>
    </message>
    <message>
        <source>Thickness of the wall behind a place, perpendicular to it</source>
        <translation>Stärke der Wand hinter einer Stelle, senkrecht zu ihr gemessen</translation>
    </message>
    <message>
        <source>Click on the selected model</source>
        <translation>Auf das ausgewählte Modell klicken</translation>
    </message>
    <message>
        <source>
The command line makes it with%1 --refine-pass-poses</source>
        <translation>
Auf der Befehlszeile entsteht es mit%1 --refine-pass-poses</translation>
    </message>
    <message>
        <source>pass %1: %2</source>
        <translation>Durchgang %1: %2</translation>
    </message>
    <message>
        <source>%1 of pass %2</source>
        <translation>%1 aus Durchgang %2</translation>
    </message>
    <message>
        <source>Not measured</source>
        <translation>Nicht gemessen</translation>
    </message>
    <message>
        <source>no view saw it</source>
        <translation>von keiner Ansicht erfasst</translation>
    </message>
    <message>
        <source>Nearly all of its surface was seen.</source>
        <translation>Fast die gesamte Oberfläche wurde erfasst.</translation>
    </message>
    <message>
        <source>Count contributions</source>
        <translation>Beiträge zählen</translation>
    </message>
    <message>
        <source>Put nothing on the table and press Calibrate; or record at once: the object&apos;s motion shows where the table is.</source>
        <translation>Nichts auf den Drehteller stellen und „Kalibrieren“ drücken; oder sofort aufnehmen: Die Bewegung des Objekts zeigt, wo der Drehteller steht.</translation>
    </message>
    <message>
        <source>%1 %2 (default %3)</source>
        <translation>%1 %2 (Standard: %3)</translation>
    </message>
    <message>
        <source>Made with the defaults</source>
        <translation>Mit den Standardwerten erstellt</translation>
    </message>
    <message>
        <source>Made with</source>
        <translation>Erstellt mit</translation>
    </message>
    <message>
        <source>
Found from the data</source>
        <translation>
Aus den Daten ermittelt</translation>
    </message>
    <message>
        <source>
Edited or duplicated since</source>
        <translation>
Seitdem bearbeitet oder dupliziert</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ComparePanel</name>
    <message>
        <source>Options of distances</source>
        <translation>Optionen der Abstände</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Side by side</source>
        <translation>Nebeneinander</translation>
    </message>
    <message>
        <source>Both with one camera</source>
        <translation>Beide mit derselben Kamera</translation>
    </message>
    <message>
        <source>Overlay</source>
        <translation>Überlagern</translation>
    </message>
    <message>
        <source>One over the other</source>
        <translation>Eines über dem anderen</translation>
    </message>
    <message>
        <source>Distances</source>
        <translation>Abstände</translation>
    </message>
    <message>
        <source>Colour the model by its distance to the reference</source>
        <translation>Das Modell nach seinem Abstand zur Referenz einfärben</translation>
    </message>
    <message>
        <source>Distances are to a mesh: choose one as the reference.</source>
        <translation>Abstände werden zu einem Netz gemessen: Wählen Sie eines als Referenz.</translation>
    </message>
    <message>
        <source>%1 is %2 times as large as %3: are both in the same unit?</source>
        <translation>%1 ist %2-mal so groß wie %3: Haben beide dieselbe Einheit?</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::DeviationPanel</name>
    <message>
        <source>What deviates by less is grey: it is in tolerance</source>
        <translation>Was weniger abweicht, ist grau: Es liegt in der Toleranz</translation>
    </message>
    <message>
        <source>The deviation of the darkest colours; automatic: 95 of 100 vertices deviate less</source>
        <translation>Abweichung der dunkelsten Farben; automatisch: 95 von 100 Eckpunkten weichen weniger ab</translation>
    </message>
    <message>
        <source>Deviations</source>
        <translation>Abweichungen</translation>
    </message>
    <message>
        <source>Colour the selected model by its signed distance to the reference: red outside of it, blue inside</source>
        <translation>Das ausgewählte Modell nach seinem vorzeichenbehafteten Abstand zur Referenz einfärben: rot außerhalb, blau innerhalb</translation>
    </message>
    <message>
        <source>Align to it</source>
        <translation>Daran ausrichten</translation>
    </message>
    <message>
        <source>Move the selected model rigidly onto the reference, from where it lies</source>
        <translation>Das ausgewählte Modell von seiner jetzigen Lage aus starr auf die Referenz bewegen</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Ausblenden</translation>
    </message>
    <message>
        <source>Show the model in its own colours again</source>
        <translation>Das Modell wieder in seinen eigenen Farben anzeigen</translation>
    </message>
    <message>
        <source>Export CSV…</source>
        <translation>CSV exportieren…</translation>
    </message>
    <message>
        <source>The deviation of each vertex or point</source>
        <translation>Die Abweichung jedes Eckpunkts oder Punkts</translation>
    </message>
    <message>
        <source>Reference of deviations</source>
        <translation>Referenz der Abweichungen</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>automatisch</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>Toleranz</translation>
    </message>
    <message>
        <source>Range of colours</source>
        <translation>Farbbereich</translation>
    </message>
    <message>
        <source>Deviation from %1</source>
        <translation>Abweichung von %1</translation>
    </message>
    <message>
        <source>Colour the deviations</source>
        <translation>Abweichungen einfärben</translation>
    </message>
    <message>
        <source>%1 to %2: mean %3, rms %4, from %5 to %6 mm. Within ±%7 mm %8 %, above %9 %, below %10 %. The reference is not drawn meanwhile.</source>
        <translation>%1 zu %2: Mittel %3, RMS %4, von %5 bis %6 mm. Innerhalb ±%7 mm %8 %, darüber %9 %, darunter %10 %. Die Referenz wird währenddessen nicht dargestellt.</translation>
    </message>
    <message>
        <source>Align</source>
        <translation>Ausrichten</translation>
    </message>
    <message>
        <source>align %1</source>
        <translation>%1 ausrichten</translation>
    </message>
    <message>
        <source>%1 to %2: </source>
        <translation>%1 auf %2: </translation>
    </message>
    <message>
        <source>Export deviations</source>
        <translation>Abweichungen exportieren</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>Tabelle (*.csv)</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>%1 exportieren</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 gespeichert</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::EditPanel</name>
    <message>
        <source>Rectangle</source>
        <translation>Rechteck</translation>
    </message>
    <message>
        <source>Select what a rectangle on the screen encloses</source>
        <translation>Auswählen, was ein Rechteck auf dem Bildschirm umschließt</translation>
    </message>
    <message>
        <source>Lasso</source>
        <translation>Lasso</translation>
    </message>
    <message>
        <source>Select what an outline on the screen encloses</source>
        <translation>Auswählen, was ein Umriss auf dem Bildschirm umschließt</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinsel</translation>
    </message>
    <message>
        <source>Select what is painted over</source>
        <translation>Auswählen, was übermalt wird</translation>
    </message>
    <message>
        <source>; with Shift it is added, with Ctrl subtracted, with Alt the mouse turns the camera</source>
        <translation>; mit Umschalt wird hinzugefügt, mit Strg abgezogen, mit Alt dreht die Maus die Kamera</translation>
    </message>
    <message>
        <source>Select</source>
        <translation>Auswählen</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
    <message>
        <source>Subtract</source>
        <translation>Abziehen</translation>
    </message>
    <message>
        <source>What the tool does with what was selected before</source>
        <translation>Was das Werkzeug mit der bisherigen Auswahl tut</translation>
    </message>
    <message>
        <source>Through</source>
        <translation>Durchgehend</translation>
    </message>
    <message>
        <source>Select what is hidden behind other parts, too</source>
        <translation>Auch auswählen, was hinter anderen Teilen verborgen ist</translation>
    </message>
    <message>
        <source>Radius of the brush on the screen</source>
        <translation>Radius des Pinsels auf dem Bildschirm</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Alles</translation>
    </message>
    <message>
        <source>Select the whole model</source>
        <translation>Das ganze Modell auswählen</translation>
    </message>
    <message>
        <source>Invert</source>
        <translation>Umkehren</translation>
    </message>
    <message>
        <source>Select what is not selected</source>
        <translation>Auswählen, was nicht ausgewählt ist</translation>
    </message>
    <message>
        <source>Nothing</source>
        <translation>Nichts</translation>
    </message>
    <message>
        <source>Forget the selection</source>
        <translation>Die Auswahl aufheben</translation>
    </message>
    <message>
        <source>Grow</source>
        <translation>Erweitern</translation>
    </message>
    <message>
        <source>Add the neighbours of what is selected</source>
        <translation>Die Nachbarn der Auswahl hinzufügen</translation>
    </message>
    <message>
        <source>Shrink</source>
        <translation>Verkleinern</translation>
    </message>
    <message>
        <source>Leave out the rim of the selection</source>
        <translation>Den Rand der Auswahl weglassen</translation>
    </message>
    <message>
        <source>Connected</source>
        <translation>Verbunden</translation>
    </message>
    <message>
        <source>Add everything that is connected to the selection</source>
        <translation>Alles hinzufügen, was mit der Auswahl verbunden ist</translation>
    </message>
    <message>
        <source>Delete selected</source>
        <translation>Auswahl löschen</translation>
    </message>
    <message>
        <source>Delete what is selected (Del)</source>
        <translation>Das Ausgewählte löschen (Entf)</translation>
    </message>
    <message>
        <source>Fill holes</source>
        <translation>Löcher schließen</translation>
    </message>
    <message>
        <source>Close the holes beside the selection; without one, all</source>
        <translation>Die Löcher neben der Auswahl schließen; ohne Auswahl alle</translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation>Glätten</translation>
    </message>
    <message>
        <source>Smooth waves shorter than this in the selection; without one, in the whole mesh</source>
        <translation>Wellen, die kürzer als dieser Wert sind, in der Auswahl glätten; ohne Auswahl im ganzen Netz</translation>
    </message>
    <message>
        <source>Reduce to</source>
        <translation>Reduzieren auf</translation>
    </message>
    <message>
        <source>Reduce to this number by merging triangles of the selection; without one, of the whole mesh</source>
        <translation>Auf diese Anzahl reduzieren, indem Dreiecke der Auswahl zusammengefasst werden; ohne Auswahl im ganzen Netz</translation>
    </message>
    <message>
        <source>Waves of this length lose half of their height</source>
        <translation>Wellen dieser Länge verlieren die Hälfte ihrer Höhe</translation>
    </message>
    <message>
        <source>Triangles of the whole mesh afterwards</source>
        <translation>Dreiecke des ganzen Netzes danach</translation>
    </message>
    <message>
        <source>Flat cut</source>
        <translation>Ebener Schnitt</translation>
    </message>
    <message>
        <source>Take away one side of a plane; the cut of a closed mesh is closed</source>
        <translation>Eine Seite einer Ebene entfernen; der Schnitt eines geschlossenen Netzes wird geschlossen</translation>
    </message>
    <message>
        <source>Cut off what is not shown</source>
        <translation>Abschneiden, was nicht gezeigt wird</translation>
    </message>
    <message>
        <source>Choose a mesh or cloud above</source>
        <translation>Oben ein Netz oder eine Wolke wählen</translation>
    </message>
    <message>
        <source>Nothing selected</source>
        <translation>Nichts ausgewählt</translation>
    </message>
    <message>
        <source>%1 of %2 triangles selected</source>
        <translation>%1 von %2 Dreiecken ausgewählt</translation>
    </message>
    <message>
        <source>%1 of %2 points selected</source>
        <translation>%1 von %2 Punkten ausgewählt</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>%1 closed</source>
        <translation>%1 geschlossen</translation>
    </message>
    <message>
        <source>waves below %1 mm</source>
        <translation>Wellen unter %1 mm</translation>
    </message>
    <message>
        <source>Reduce</source>
        <translation>Reduzieren</translation>
    </message>
    <message>
        <source>%1 triangles, before %2</source>
        <translation>%1 Dreiecke, vorher %2</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Schneiden</translation>
    </message>
    <message>
        <source>one side of the plane is left</source>
        <translation>eine Seite der Ebene bleibt übrig</translation>
    </message>
    <message>
        <source>closed by a face of %1 cm²</source>
        <translation>durch eine Fläche von %1 cm² geschlossen</translation>
    </message>
    <message>
        <source>the cut is open, as the mesh was not closed</source>
        <translation>der Schnitt ist offen, da das Netz nicht geschlossen war</translation>
    </message>
    <message>
        <source>select</source>
        <translation>Auswählen</translation>
    </message>
    <message>
        <source>%1; its texture does not fit any more</source>
        <translation>%1; die Textur passt nicht mehr</translation>
    </message>
    <message>
        <source>Small pieces</source>
        <translation>Kleine Teile</translation>
    </message>
    <message>
        <source>Select every separate piece below a twentieth of the largest one</source>
        <translation>Jedes einzelne Teil auswählen, das kleiner als ein Zwanzigstel des größten ist</translation>
    </message>
    <message numerus="yes">
        <source>%n small piece(s) selected</source>
        <translation>
            <numerusform>%n kleines Teil ausgewählt</numerusform>
            <numerusform>%n kleine Teile ausgewählt</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>; %n small piece(s) left, see Small pieces</source>
        <translation>
            <numerusform>; %n kleines Teil übrig, siehe „Kleine Teile“</numerusform>
            <numerusform>; %n kleine Teile übrig, siehe „Kleine Teile“</numerusform>
        </translation>
    </message>
    <message>
        <source>%1 is hidden: show it in the list first</source>
        <translation>%1 ist ausgeblendet: zuerst in der Liste einblenden</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ExplorerMode</name>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Another side</source>
        <translation>Weitere Seite</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Nothing loaded yet</source>
        <translation>Noch nichts geladen</translation>
    </message>
    <message>
        <source>Drop meshes, point clouds or recordings here, or begin with a scan.</source>
        <translation>Netze, Punktwolken oder Aufnahmen hier ablegen oder mit einem Scan beginnen.</translation>
    </message>
    <message>
        <source>Open…</source>
        <translation>Öffnen…</translation>
    </message>
    <message>
        <source>Scan an object</source>
        <translation>Objekt scannen</translation>
    </message>
    <message>
        <source>Simulate a scan</source>
        <translation>Scan simulieren</translation>
    </message>
    <message>
        <source>Open meshes, clouds or recordings</source>
        <translation>Netze, Wolken oder Aufnahmen öffnen</translation>
    </message>
    <message>
        <source>Meshes, clouds and recordings (*.ply *.pcd *.stl *.obj *.off *.3mf *.glb *.dae *.fbx recording.json *.bag *.mcap *.db3 *.mkv *.r3d *.sens *.conf *.json);;All files (*)</source>
        <translation>Netze, Wolken und Aufnahmen (*.ply *.pcd *.stl *.obj *.off *.3mf *.glb *.dae *.fbx recording.json *.bag *.mcap *.db3 *.mkv *.r3d *.sens *.conf *.json);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Save %1</source>
        <translation>%1 speichern</translation>
    </message>
    <message>
        <source>PLY (*.ply);;STL, millimetres (*.stl);;3MF, millimetres (*.3mf);;OBJ (*.obj);;GLB (*.glb)</source>
        <translation>PLY (*.ply);;STL, Millimeter (*.stl);;3MF, Millimeter (*.3mf);;OBJ (*.obj);;GLB (*.glb)</translation>
    </message>
    <message>
        <source>PLY (*.ply)</source>
        <translation>PLY (*.ply)</translation>
    </message>
    <message>
        <source>Export the report of %1</source>
        <translation>Bericht zu %1 exportieren</translation>
    </message>
    <message>
        <source>Report page (*.html)</source>
        <translation>Berichtsseite (*.html)</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>%1 öffnen</translation>
    </message>
    <message>
        <source>open %1</source>
        <translation>%1 öffnen</translation>
    </message>
    <message>
        <source>reconstruct</source>
        <translation>Rekonstruieren</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filtern</translation>
    </message>
    <message>
        <source>%1 filtered</source>
        <translation>%1 gefiltert</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 zu %2</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 gespeichert</translation>
    </message>
    <message>
        <source>Colour the mesh</source>
        <translation>Netz einfärben</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>%1 exportieren</translation>
    </message>
    <message>
        <source>; without the 3D view, which this build lacks</source>
        <translation>; ohne die 3D-Ansicht, die in dieser Version fehlt</translation>
    </message>
    <message>
        <source>Wrote %1%2</source>
        <translation>%1 gespeichert%2</translation>
    </message>
    <message>
        <source>Restore the session</source>
        <translation>Sitzung wiederherstellen</translation>
    </message>
    <message>
        <source>restore the session</source>
        <translation>Sitzung wiederherstellen</translation>
    </message>
    <message>
        <source>These could not be restored, and are kept in %1: %2</source>
        <translation>Folgende konnten nicht wiederhergestellt werden und bleiben in %1 erhalten: %2</translation>
    </message>
    <message>
        <source>Save preset</source>
        <translation>Voreinstellung speichern</translation>
    </message>
    <message>
        <source>Select a mesh or a cloud to export</source>
        <translation>Ein Netz oder eine Wolke zum Exportieren auswählen</translation>
    </message>
    <message>
        <source>Pictures, NAME-0001.png and so on (*.png)</source>
        <translation>Bilder, NAME-0001.png usw. (*.png)</translation>
    </message>
    <message>
        <source>Turntable movie</source>
        <translation>Drehfilm</translation>
    </message>
    <message>
        <source>Film (*.mp4)</source>
        <translation>Film (*.mp4)</translation>
    </message>
    <message>
        <source>Reconstruct %1</source>
        <translation>%1 rekonstruieren</translation>
    </message>
    <message>
        <source>reconstruct %1</source>
        <translation>%1 rekonstruieren</translation>
    </message>
    <message>
        <source>Deviations</source>
        <translation>Abweichungen</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>Schnitt</translation>
    </message>
    <message>
        <source>Editing</source>
        <translation>Bearbeitung</translation>
    </message>
    <message>
        <source>History</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>filter %1</source>
        <translation>%1 filtern</translation>
    </message>
    <message>
        <source>distances</source>
        <translation>Abstände</translation>
    </message>
    <message>
        <source>Join by points</source>
        <translation>Über Punkte verbinden</translation>
    </message>
    <message>
        <source>%1
Another side, Join by points shows how it lay.</source>
        <translation>%1
Unter „Weitere Seite“ lässt sich mit „Über Punkte verbinden“ zeigen, wie es lag.</translation>
    </message>
    <message>
        <source>Voxels</source>
        <translation>Voxel</translation>
    </message>
    <message>
        <source>Stages</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>Voxelise keeps voxels with %1 points or more from now on</source>
        <translation>„Voxelisieren“ behält ab jetzt Voxel mit mindestens %1 Punkten</translation>
    </message>
    <message>
        <source>%1 was not opened</source>
        <translation>%1 wurde nicht geöffnet</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Einzelbilder</translation>
    </message>
    <message>
        <source>Inspect</source>
        <translation>Prüfen</translation>
    </message>
    <message>
        <source>Edit</source>
        <translation>Bearbeiten</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Process</source>
        <translation>Verarbeiten</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ExportDialog</name>
    <message>
        <source>Export %1</source>
        <translation>%1 exportieren</translation>
    </message>
    <message>
        <source>PLY</source>
        <translation>PLY</translation>
    </message>
    <message>
        <source>STL, for printing</source>
        <translation>STL, zum Drucken</translation>
    </message>
    <message>
        <source>3MF, for printing, with colours</source>
        <translation>3MF, zum Drucken, mit Farben</translation>
    </message>
    <message>
        <source>OBJ</source>
        <translation>OBJ</translation>
    </message>
    <message>
        <source>GLB, for the web</source>
        <translation>GLB, für das Web</translation>
    </message>
    <message>
        <source>Millimetres</source>
        <translation>Millimeter</translation>
    </message>
    <message>
        <source>Centimetres</source>
        <translation>Zentimeter</translation>
    </message>
    <message>
        <source>Inches</source>
        <translation>Zoll</translation>
    </message>
    <message>
        <source>Metres</source>
        <translation>Meter</translation>
    </message>
    <message>
        <source>Usual for the format: Z in STL and 3MF, else Y</source>
        <translation>Wie im Format üblich: Z bei STL und 3MF, sonst Y</translation>
    </message>
    <message>
        <source>Y, as in the view</source>
        <translation>Y, wie in der Ansicht</translation>
    </message>
    <message>
        <source>Z, as slicers and CAD have it</source>
        <translation>Z, wie in Slicern und CAD</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Textur</translation>
    </message>
    <message>
        <source>Colours of the vertices</source>
        <translation>Farben der Eckpunkte</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keine</translation>
    </message>
    <message>
        <source>all %1</source>
        <translation>alle %1</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>Format</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Hochachse</translation>
    </message>
    <message>
        <source>Triangles, at most</source>
        <translation>Dreiecke, höchstens</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exportieren…</translation>
    </message>
    <message>
        <source>The format says its unit: %1.</source>
        <translation>Das Format nennt seine Einheit: %1.</translation>
    </message>
    <message>
        <source>GLB is always Y up.</source>
        <translation>Bei GLB zeigt immer Y nach oben.</translation>
    </message>
    <message>
        <source>With fewer triangles the texture becomes colours of the vertices.</source>
        <translation>Bei weniger Dreiecken wird die Textur zu Farben der Eckpunkte.</translation>
    </message>
    <message>
        <source>This format keeps no texture.</source>
        <translation>Dieses Format speichert keine Textur.</translation>
    </message>
    <message>
        <source>STL keeps no colours.</source>
        <translation>STL speichert keine Farben.</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::FramePanel</name>
    <message>
        <source>Frame of the recording</source>
        <translation>Bild der Aufnahme</translation>
    </message>
    <message>
        <source>Arrow keys step from frame to frame; frames left out are marked</source>
        <translation>Pfeiltasten wechseln von Bild zu Bild; ausgelassene Bilder sind markiert</translation>
    </message>
    <message>
        <source>Depth image</source>
        <translation>Tiefenbild</translation>
    </message>
    <message>
        <source>Colour image</source>
        <translation>Farbbild</translation>
    </message>
    <message>
        <source>Frame %1 of %2</source>
        <translation>Bild %1 von %2</translation>
    </message>
    <message>
        <source>sensor %1</source>
        <translation>Sensor %1</translation>
    </message>
    <message>
        <source>pass %1</source>
        <translation>Durchgang %1</translation>
    </message>
    <message>
        <source>lost while it was recorded</source>
        <translation>bei der Aufnahme verloren</translation>
    </message>
    <message>
        <source>left out of the mesh, because its pose is not known</source>
        <translation>nicht im Netz, weil die Pose nicht bekannt ist</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Yellow is %1 m from the sensor, violet %2 m</source>
        <translation>Gelb ist %1 m vom Sensor entfernt, Violett %2 m</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::HistoryPanel</name>
    <message>
        <source>History</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>A click goes back to that state, or forward again</source>
        <translation>Ein Klick geht zu diesem Stand zurück oder wieder vor</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Anfang</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::JobBar</name>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Stop the running job (Esc)</source>
        <translation>Den laufenden Vorgang abbrechen (Esc)</translation>
    </message>
    <message>
        <source>Progress of the running job</source>
        <translation>Fortschritt des laufenden Vorgangs</translation>
    </message>
    <message>
        <source>%1 s so far</source>
        <translation>bisher %1 s</translation>
    </message>
    <message>
        <source>%1 more</source>
        <translation>%1 weitere</translation>
    </message>
    <message>
        <source>Next:</source>
        <translation>Danach:</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::JoinPanel</name>
    <message>
        <source>Mesh so far</source>
        <translation>Bisheriges Netz</translation>
    </message>
    <message>
        <source>New pass</source>
        <translation>Neuer Durchgang</translation>
    </message>
    <message>
        <source>Pick pairs</source>
        <translation>Paare wählen</translation>
    </message>
    <message>
        <source>Click at least three places, each on both meshes</source>
        <translation>Mindestens drei Stellen anklicken, jede auf beiden Netzen</translation>
    </message>
    <message>
        <source>Undo click</source>
        <translation>Klick zurück</translation>
    </message>
    <message>
        <source>Take the last click back</source>
        <translation>Den letzten Klick zurücknehmen</translation>
    </message>
    <message>
        <source>Join</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Bring the new pass there, refine its place by the surfaces, and make one mesh of all passes; refused where the surfaces contradict it</source>
        <translation>Den neuen Durchgang dorthin bringen, seine Lage anhand der Oberflächen verfeinern und aus allen Durchgängen ein Netz erstellen; wird abgelehnt, wo die Oberflächen widersprechen</translation>
    </message>
    <message>
        <source>Each pass by itself</source>
        <translation>Durchgänge einzeln</translation>
    </message>
    <message>
        <source>Make a mesh of each pass of the selected joined one, to join them anew</source>
        <translation>Aus jedem Durchgang des ausgewählten verbundenen Netzes ein eigenes Netz erstellen, um sie neu zu verbinden</translation>
    </message>
    <message>
        <source>Where a pass was not joined, or wrongly, pairs of places on both meshes say how it lay.</source>
        <translation>Wurde ein Durchgang nicht oder falsch verbunden, geben Paare von Stellen auf beiden Netzen an, wie er lag.</translation>
    </message>
    <message>
        <source>Choose meshes of different passes of one recording.</source>
        <translation>Wählen Sie Netze verschiedener Durchgänge einer Aufnahme.</translation>
    </message>
    <message>
        <source>Pair %1: click the same place on both.</source>
        <translation>Paar %1: dieselbe Stelle auf beiden anklicken.</translation>
    </message>
    <message>
        <source>Pair %1: click it on the right, too.</source>
        <translation>Paar %1: nun auch rechts anklicken.</translation>
    </message>
    <message>
        <source>Pair %1: click it on the left, too.</source>
        <translation>Paar %1: nun auch links anklicken.</translation>
    </message>
    <message>
        <source>%1 pairs, which fit within %2 mm (rms). Join, or click more.</source>
        <translation>%1 Paare, die auf %2 mm (RMS) zusammenpassen. Verbinden oder weitere anklicken.</translation>
    </message>
    <message>
        <source>join by points</source>
        <translation>Über Punkte verbinden</translation>
    </message>
    <message>
        <source>%1 and %2 are one mesh now</source>
        <translation>%1 und %2 sind jetzt ein Netz</translation>
    </message>
    <message>
        <source>passes by themselves</source>
        <translation>Durchgänge einzeln</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::LookPanel</name>
    <message>
        <source>Opacity of the selected model</source>
        <translation>Deckkraft des ausgewählten Modells</translation>
    </message>
    <message>
        <source>Isolate</source>
        <translation>Isolieren</translation>
    </message>
    <message>
        <source>Show the selected model alone</source>
        <translation>Nur das ausgewählte Modell anzeigen</translation>
    </message>
    <message>
        <source>Turntable movie…</source>
        <translation>Drehfilm…</translation>
    </message>
    <message>
        <source>A film or pictures of the view, turned once about the vertical</source>
        <translation>Ein Film oder Bilder der Ansicht, einmal um die Senkrechte gedreht</translation>
    </message>
    <message>
        <source>Ambient occlusion</source>
        <translation>Umgebungsverdeckung</translation>
    </message>
    <message>
        <source>Shaded</source>
        <translation>Schattiert</translation>
    </message>
    <message>
        <source>Shaded, with edges</source>
        <translation>Schattiert mit Kanten</translation>
    </message>
    <message>
        <source>Wireframe</source>
        <translation>Drahtgitter</translation>
    </message>
    <message>
        <source>Normals</source>
        <translation>Normalen</translation>
    </message>
    <message>
        <source>How surfaces are drawn; normals: x red, y green, z blue</source>
        <translation>Wie Oberflächen gezeichnet werden; Normalen: x rot, y grün und z blau</translation>
    </message>
    <message>
        <source>Draw recesses darker (ambient occlusion) while the view does not move; slow without a graphics card</source>
        <translation>Vertiefungen dunkler zeichnen (Umgebungsverdeckung), solange sich die Ansicht nicht bewegt; langsam ohne Grafikkarte</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>Oberfläche</translation>
    </message>
    <message>
        <source>Opacity</source>
        <translation>Deckkraft</translation>
    </message>
    <message>
        <source>Clip</source>
        <translation>Clipping</translation>
    </message>
    <message>
        <source>Axis of the clipping plane</source>
        <translation>Achse der Clipping-Ebene</translation>
    </message>
    <message>
        <source>Off</source>
        <translation>Aus</translation>
    </message>
    <message>
        <source>Place of the clipping plane</source>
        <translation>Position der Clipping-Ebene</translation>
    </message>
    <message>
        <source>Flip</source>
        <translation>Umkehren</translation>
    </message>
    <message>
        <source>Show the other side</source>
        <translation>Die andere Seite anzeigen</translation>
    </message>
    <message>
        <source>Show the other side of the clipping plane</source>
        <translation>Die andere Seite der Clipping-Ebene anzeigen</translation>
    </message>
    <message>
        <source>Stages…</source>
        <translation>Schritte…</translation>
    </message>
    <message>
        <source>What is checked in the list, side by side in one picture</source>
        <translation>Was in der Liste angehakt ist, nebeneinander in einem Bild</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MainWindow</name>
    <message>
        <source>Left button</source>
        <translation>Linke Taste</translation>
    </message>
    <message>
        <source>turn</source>
        <translation>drehen</translation>
    </message>
    <message>
        <source>Middle button, or Shift and left</source>
        <translation>Mittlere Taste oder Umschalt und linke</translation>
    </message>
    <message>
        <source>move</source>
        <translation>verschieben</translation>
    </message>
    <message>
        <source>Wheel, or right button</source>
        <translation>Rad oder rechte Taste</translation>
    </message>
    <message>
        <source>nearer, farther</source>
        <translation>näher, weiter weg</translation>
    </message>
    <message>
        <source>Arrows, +, -</source>
        <translation>Pfeiltasten, +, -</translation>
    </message>
    <message>
        <source>turn, nearer, farther</source>
        <translation>drehen, näher, weiter weg</translation>
    </message>
    <message>
        <source>Keyboard shortcuts</source>
        <translation>Tastenkürzel</translation>
    </message>
    <message>
        <source>The manual is not installed here</source>
        <translation>Das Handbuch ist hier nicht installiert</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>Messages, oldest first</source>
        <translation>Meldungen, älteste zuerst</translation>
    </message>
    <message>
        <source>Messages</source>
        <translation>Meldungen</translation>
    </message>
    <message>
        <source>From an object on a turntable to a watertight mesh.</source>
        <translation>Vom Objekt auf dem Drehteller zum wasserdichten Netz.</translation>
    </message>
    <message>
        <source>turnscan is free software under the Apache License 2.0, whose text is below.</source>
        <translation>turnscan ist freie Software unter der Apache-Lizenz 2.0, deren Text unten steht.</translation>
    </message>
    <message>
        <source>It uses these libraries, with Qt %1 and VTK %2:</source>
        <translation>Es verwendet diese Bibliotheken, mit Qt %1 und VTK %2:</translation>
    </message>
    <message>
        <source>About turnscan Studio</source>
        <translation>Über turnscan Studio</translation>
    </message>
    <message>
        <source>Open a recording</source>
        <translation>Aufnahme öffnen</translation>
    </message>
    <message>
        <source>Save screenshot</source>
        <translation>Bildschirmfoto speichern</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Bilder (*.png)</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation>Ö&amp;ffnen…</translation>
    </message>
    <message>
        <source>Open &amp;recording…</source>
        <translation>A&amp;ufnahme öffnen…</translation>
    </message>
    <message>
        <source>Open r&amp;ecent</source>
        <translation>&amp;Zuletzt geöffnet</translation>
    </message>
    <message>
        <source>&amp;Save…</source>
        <translation>&amp;Speichern…</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation>&amp;Exportieren…</translation>
    </message>
    <message>
        <source>Reconstruct se&amp;veral recordings…</source>
        <translation>Mehrere Aufnahmen &amp;rekonstruieren…</translation>
    </message>
    <message>
        <source>Save s&amp;creenshot…</source>
        <translation>Bildschirmfo&amp;to speichern…</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Cancel the running job</source>
        <translation>Laufenden Vorgang abbrechen</translation>
    </message>
    <message>
        <source>&amp;Language</source>
        <translation>&amp;Sprache</translation>
    </message>
    <message>
        <source>The language changes with the next start</source>
        <translation>Die Sprache wechselt beim nächsten Start</translation>
    </message>
    <message>
        <source>As the system</source>
        <translation>Wie das System</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>Reset camera</source>
        <translation>Kamera zurücksetzen</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Vorne</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Hinten</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Links</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>Bottom</source>
        <translation>Unten</translation>
    </message>
    <message>
        <source>Corner</source>
        <translation>Ecke</translation>
    </message>
    <message>
        <source>Bounding boxes</source>
        <translation>Hüllquader</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>&amp;Manual</source>
        <translation>&amp;Handbuch</translation>
    </message>
    <message>
        <source>&amp;Keyboard shortcuts</source>
        <translation>&amp;Tastenkürzel</translation>
    </message>
    <message>
        <source>&amp;About turnscan Studio</source>
        <translation>Ü&amp;ber turnscan Studio</translation>
    </message>
    <message>
        <source>turnscan Studio</source>
        <translation>turnscan Studio</translation>
    </message>
    <message>
        <source>3D Scanner</source>
        <translation>3D-Scanner</translation>
    </message>
    <message>
        <source>Calibrate and record with a sensor (F1)</source>
        <translation>Mit einem Sensor kalibrieren und aufnehmen (F1)</translation>
    </message>
    <message>
        <source>Model Explorer</source>
        <translation>Modell-Explorer</translation>
    </message>
    <message>
        <source>Look at models and process them (F2)</source>
        <translation>Modelle ansehen und verarbeiten (F2)</translation>
    </message>
    <message>
        <source>Scanner Simulator</source>
        <translation>Scanner-Simulator</translation>
    </message>
    <message>
        <source>Try a rig before it is built (F3)</source>
        <translation>Einen Aufbau ausprobieren, bevor er gebaut wird (F3)</translation>
    </message>
    <message>
        <source>%1: cancelled</source>
        <translation>%1: abgebrochen</translation>
    </message>
    <message>
        <source>%1: failed</source>
        <translation>%1: fehlgeschlagen</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 gespeichert</translation>
    </message>
    <message>
        <source>No files yet</source>
        <translation>Noch keine Dateien</translation>
    </message>
    <message>
        <source>Undo %1</source>
        <translation>Rückgängig: %1</translation>
    </message>
    <message>
        <source>Redo %1</source>
        <translation>Wiederholen: %1</translation>
    </message>
    <message>
        <source>A recording runs; it ends, and what it has is kept</source>
        <translation>Eine Aufnahme läuft; sie wird beendet, das Aufgenommene bleibt erhalten</translation>
    </message>
    <message>
        <source>Go on with the recording?</source>
        <translation>Aufnahme fortsetzen?</translation>
    </message>
    <message numerus="yes">
        <source>The last session ended while it recorded. %1 has %n frame(s).</source>
        <translation>
            <numerusform>Die letzte Sitzung endete während einer Aufnahme. %1 hat %n Bild.</numerusform>
            <numerusform>Die letzte Sitzung endete während einer Aufnahme. %1 hat %n Bilder.</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Fortsetzen</translation>
    </message>
    <message>
        <source>Leave it</source>
        <translation>Nicht fortsetzen</translation>
    </message>
    <message>
        <source>Restore the last session?</source>
        <translation>Letzte Sitzung wiederherstellen?</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Ask again later</source>
        <translation>Später fragen</translation>
    </message>
    <message>
        <source>All models are in files</source>
        <translation>Alle Modelle sind in Dateien gespeichert</translation>
    </message>
    <message>
        <source>Folder for all models</source>
        <translation>Ordner für alle Modelle</translation>
    </message>
    <message>
        <source>Save &amp;all…</source>
        <translation>A&amp;lle speichern…</translation>
    </message>
    <message numerus="yes">
        <source>%n model(s) cannot be kept for the next start and are in no file: %1</source>
        <translation>
            <numerusform>%n Modell kann nicht für den nächsten Start aufbewahrt werden und ist in keiner Datei: %1</numerusform>
            <numerusform>%n Modelle können nicht für den nächsten Start aufbewahrt werden und sind in keiner Datei: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>The last session had these models:
%1</source>
        <translation>Die letzte Sitzung enthielt diese Modelle:
%1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MeasurePanel</name>
    <message>
        <source>A plane is fitted to the surface within this distance of the click</source>
        <translation>Eine Ebene wird an die Oberfläche innerhalb dieses Abstands vom Klick angepasst</translation>
    </message>
    <message>
        <source>Radius of the patch that a plane is fitted to</source>
        <translation>Radius des Bereichs, an den eine Ebene angepasst wird</translation>
    </message>
    <message>
        <source>Plane within</source>
        <translation>Ebene innerhalb</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Remove the chosen measurement</source>
        <translation>Die gewählte Messung entfernen</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>Leeren</translation>
    </message>
    <message>
        <source>Remove all measurements</source>
        <translation>Alle Messungen entfernen</translation>
    </message>
    <message>
        <source>Export CSV…</source>
        <translation>CSV exportieren…</translation>
    </message>
    <message>
        <source>All measurements as a table</source>
        <translation>Alle Messungen als Tabelle</translation>
    </message>
    <message>
        <source>Place %1 of %2</source>
        <translation>Stelle %1 von %2</translation>
    </message>
    <message>
        <source>Export measurements</source>
        <translation>Messungen exportieren</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>Tabelle (*.csv)</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>%1 exportieren</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 gespeichert</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MessageLog</name>
    <message>
        <source>Error: </source>
        <translation>Fehler: </translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ModelList</name>
    <message>
        <source>Properties of the selected model</source>
        <translation>Eigenschaften des ausgewählten Modells</translation>
    </message>
    <message>
        <source>Open…</source>
        <translation>Öffnen…</translation>
    </message>
    <message>
        <source>Load meshes, clouds or recordings (Ctrl+O)</source>
        <translation>Netze, Wolken oder Aufnahmen laden (Strg+O)</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Speichern…</translation>
    </message>
    <message>
        <source>Save the selected model (Ctrl+S)</source>
        <translation>Das ausgewählte Modell speichern (Strg+S)</translation>
    </message>
    <message>
        <source>Edit</source>
        <translation>Bearbeiten</translation>
    </message>
    <message>
        <source>Rename, colour, duplicate, delete</source>
        <translation>Umbenennen, einfärben, duplizieren, löschen</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>Colour…</source>
        <translation>Farbe…</translation>
    </message>
    <message>
        <source>Own colours on/off</source>
        <translation>Eigene Farben ein/aus</translation>
    </message>
    <message>
        <source>Duplicate</source>
        <translation>Duplizieren</translation>
    </message>
    <message>
        <source>Delete	Del</source>
        <translation>Löschen	Entf</translation>
    </message>
    <message>
        <source>Colour of %1</source>
        <translation>Farbe von %1</translation>
    </message>
    <message>
        <source>Models</source>
        <translation>Modelle</translation>
    </message>
    <message>
        <source>Use its settings</source>
        <translation>Einstellungen übernehmen</translation>
    </message>
    <message>
        <source>Not made with the defaults:
%1</source>
        <translation>Nicht mit den Standardwerten erstellt:
%1</translation>
    </message>
    <message>
        <source>Pass %1</source>
        <translation>Durchgang %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ModelStore</name>
    <message>
        <source>add %1</source>
        <translation>%1 hinzufügen</translation>
    </message>
    <message>
        <source>rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>show</source>
        <translation>Einblenden</translation>
    </message>
    <message>
        <source>hide</source>
        <translation>Ausblenden</translation>
    </message>
    <message>
        <source>colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>opacity of %1</source>
        <translation>Deckkraft von %1</translation>
    </message>
    <message>
        <source>duplicate</source>
        <translation>Duplizieren</translation>
    </message>
    <message>
        <source>delete</source>
        <translation>Löschen</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MotorPanel</name>
    <message>
        <source>Serial port of the board that turns the table, e.g. /dev/ttyUSB0</source>
        <translation>Serielle Schnittstelle der Platine, die den Drehteller dreht, z. B. /dev/ttyUSB0</translation>
    </message>
    <message>
        <source>Turn</source>
        <translation>Drehen</translation>
    </message>
    <message>
        <source>Turn the table to see that it works: 10 degrees a second</source>
        <translation>Den Drehteller zur Probe drehen: 10 Grad pro Sekunde</translation>
    </message>
    <message>
        <source>With a motor, Record turns the table by itself.</source>
        <translation>Mit einem Motor dreht „Aufnehmen“ den Drehteller selbst.</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>Platine</translation>
    </message>
    <message>
        <source>No motor</source>
        <translation>Kein Motor</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Turning</source>
        <translation>Dreht sich</translation>
    </message>
    <message>
        <source>The table stands at %1 degrees</source>
        <translation>Der Drehteller steht bei %1 Grad</translation>
    </message>
    <message>
        <source>The table does not turn</source>
        <translation>Der Drehteller dreht sich nicht</translation>
    </message>
    <message>
        <source>Port of the motor</source>
        <translation>Anschluss des Motors</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::OptionForm</name>
    <message>
        <source>automatic</source>
        <translation>automatisch</translation>
    </message>
    <message>
        <source>auto: %1</source>
        <translation>auto: %1</translation>
    </message>
    <message>
        <source>&lt;br&gt;&lt;i&gt;Last run: %1, %2&lt;/i&gt;</source>
        <translation>&lt;br&gt;&lt;i&gt;Letzter Lauf: %1, %2&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;br&gt;&lt;i&gt;Not the default, %1: click to reset&lt;/i&gt;</source>
        <translation>&lt;br&gt;&lt;i&gt;Nicht der Standardwert %1: zum Zurücksetzen klicken&lt;/i&gt;</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::PlaneBox</name>
    <message>
        <source>Flip</source>
        <translation>Umkehren</translation>
    </message>
    <message>
        <source>Keep the other side</source>
        <translation>Die andere Seite behalten</translation>
    </message>
    <message>
        <source>The axis that the plane is perpendicular to</source>
        <translation>Die Achse, zu der die Ebene senkrecht steht</translation>
    </message>
    <message>
        <source>Axis of the plane</source>
        <translation>Achse der Ebene</translation>
    </message>
    <message>
        <source>Where the plane meets the axis</source>
        <translation>Wo die Ebene die Achse schneidet</translation>
    </message>
    <message>
        <source>Place of the plane</source>
        <translation>Position der Ebene</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::QueueDialog</name>
    <message>
        <source>Reconstruct several recordings</source>
        <translation>Mehrere Aufnahmen rekonstruieren</translation>
    </message>
    <message>
        <source>They are reconstructed one after the other with the options of the Model Explorer. Add recordings, or drop them here.</source>
        <translation>Sie werden nacheinander mit den Optionen des Modell-Explorers rekonstruiert. Aufnahmen hinzufügen oder hier ablegen.</translation>
    </message>
    <message>
        <source>Recordings in the queue</source>
        <translation>Aufnahmen in der Warteschlange</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Write meshes to</source>
        <translation>Netze schreiben nach</translation>
    </message>
    <message>
        <source>nowhere: they are in the Model Explorer only</source>
        <translation>nirgendwohin: Sie stehen nur im Modell-Explorer</translation>
    </message>
    <message>
        <source>running</source>
        <translation>läuft</translation>
    </message>
    <message>
        <source>cancelled</source>
        <translation>abgebrochen</translation>
    </message>
    <message>
        <source>Add recording…</source>
        <translation>Aufnahme hinzufügen…</translation>
    </message>
    <message>
        <source>The folder of a recording</source>
        <translation>Der Ordner einer Aufnahme</translation>
    </message>
    <message>
        <source>Add files…</source>
        <translation>Dateien hinzufügen…</translation>
    </message>
    <message>
        <source>Recordings of other programs</source>
        <translation>Aufnahmen anderer Programme</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Take the selected ones off the list</source>
        <translation>Die ausgewählten aus der Liste nehmen</translation>
    </message>
    <message>
        <source>Reconstruct all</source>
        <translation>Alle rekonstruieren</translation>
    </message>
    <message>
        <source>Begin with the first that waits</source>
        <translation>Mit der ersten wartenden beginnen</translation>
    </message>
    <message>
        <source>Add a recording</source>
        <translation>Aufnahme hinzufügen</translation>
    </message>
    <message>
        <source>Add recordings</source>
        <translation>Aufnahmen hinzufügen</translation>
    </message>
    <message>
        <source>waits</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>queued</source>
        <translation>eingereiht</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::RecordPanel</name>
    <message>
        <source>Folder to make; a number is added where it has content</source>
        <translation>Anzulegender Ordner; hat er schon Inhalt, wird eine Nummer angehängt</translation>
    </message>
    <message>
        <source>…</source>
        <translation>…</translation>
    </message>
    <message>
        <source>Choose the folder</source>
        <translation>Den Ordner wählen</translation>
    </message>
    <message>
        <source>Make the mesh when it is done</source>
        <translation>Danach das Netz erstellen</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Aufnehmen</translation>
    </message>
    <message>
        <source>Folder of the recording</source>
        <translation>Ordner der Aufnahme</translation>
    </message>
    <message>
        <source>The recording in %1 was ended early. It goes on with the same device and the same options.</source>
        <translation>Die Aufnahme in %1 wurde vorzeitig beendet. Sie wird mit demselben Gerät und denselben Optionen fortgesetzt.</translation>
    </message>
    <message>
        <source>Go on with the recording</source>
        <translation>Aufnahme fortsetzen</translation>
    </message>
    <message>
        <source>New recording instead</source>
        <translation>Stattdessen neue Aufnahme</translation>
    </message>
    <message>
        <source>What is recorded next is another object, or this one anew</source>
        <translation>Als Nächstes wird ein anderes Objekt aufgenommen oder dieses noch einmal</translation>
    </message>
    <message>
        <source>The next pass goes into %1. %2</source>
        <translation>Der nächste Durchgang wird in %1 gespeichert. %2</translation>
    </message>
    <message>
        <source>Motor</source>
        <translation>Motor</translation>
    </message>
    <message>
        <source>More options</source>
        <translation>Weitere Optionen</translation>
    </message>
    <message>
        <source>The motor is being tried; stop it first</source>
        <translation>Der Motor wird gerade ausprobiert; zuerst stoppen</translation>
    </message>
    <message>
        <source>turn %1</source>
        <translation>Umdrehung %1</translation>
    </message>
    <message>
        <source>turns not known yet</source>
        <translation>Umdrehungen noch unbekannt</translation>
    </message>
    <message>
        <source>, %1 GB free</source>
        <translation>, %1 GB frei</translation>
    </message>
    <message>
        <source>%1 frames, %2, %3 dropped%4</source>
        <translation>%1 Bilder, %2, %3 verloren%4</translation>
    </message>
    <message>
        <source>Seen so far: about %1 cm², %2 % of it well (from %3 sides or more)</source>
        <translation>Bisher gesehen: etwa %1 cm², davon %2 % gut (von mindestens %3 Seiten)</translation>
    </message>
    <message>
        <source>; %1 % of the surface is still missing</source>
        <translation>; %1 % der Oberfläche fehlen noch</translation>
    </message>
    <message>
        <source>Stop recording</source>
        <translation>Aufnahme beenden</translation>
    </message>
    <message>
        <source>Record another side</source>
        <translation>Weitere Seite aufnehmen</translation>
    </message>
    <message>
        <source>The surface is shown once the object&apos;s motion is known, seconds after it begins to turn.</source>
        <translation>Die Oberfläche wird gezeigt, sobald die Bewegung des Objekts bekannt ist, Sekunden nach Beginn der Drehung.</translation>
    </message>
    <message>
        <source>Recorded %1</source>
        <translation>%1 aufgenommen</translation>
    </message>
    <message>
        <source>Progress of the recording</source>
        <translation>Fortschritt der Aufnahme</translation>
    </message>
    <message>
        <source>Record until the turns are done; Space records and stops</source>
        <translation>Aufnehmen, bis die Umdrehungen fertig sind; die Leertaste startet und beendet die Aufnahme</translation>
    </message>
    <message>
        <source>It has content: the next recording goes into %1</source>
        <translation>Der Ordner hat Inhalt: Die nächste Aufnahme wird in %1 gespeichert</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ScannerEditor</name>
    <message>
        <source>What it is</source>
        <translation>Scannerdaten</translation>
    </message>
    <message>
        <source>Where it stands</source>
        <translation>Aufstellung</translation>
    </message>
    <message>
        <source>Its noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>Preset to fill the fields from</source>
        <translation>Voreinstellung, mit der die Felder ausgefüllt werden</translation>
    </message>
    <message>
        <source>Fill from…</source>
        <translation>Ausfüllen mit…</translation>
    </message>
    <message>
        <source>Save as scanner…</source>
        <translation>Als Scanner speichern…</translation>
    </message>
    <message>
        <source>These fields as a file for --scanner and for Add scanner</source>
        <translation>Diese Felder als Datei für --scanner und für „Scanner hinzufügen“</translation>
    </message>
    <message>
        <source>%1, changed</source>
        <translation>%1, geändert</translation>
    </message>
    <message>
        <source>Save as scanner</source>
        <translation>Als Scanner speichern</translation>
    </message>
    <message>
        <source>Scanners (*.toml)</source>
        <translation>Scanner (*.toml)</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ScannerMode</name>
    <message>
        <source>No picture yet</source>
        <translation>Noch kein Bild</translation>
    </message>
    <message>
        <source>Choose a device on the right and press Play. The virtual sensors need no hardware.</source>
        <translation>Rechts ein Gerät wählen und „Anzeigen“ drücken. Die virtuellen Sensoren brauchen keine Hardware.</translation>
    </message>
    <message>
        <source>Play now</source>
        <translation>Jetzt anzeigen</translation>
    </message>
    <message>
        <source>1  Device</source>
        <translation>1  Gerät</translation>
    </message>
    <message>
        <source>A device of the list, or any URI, e.g. replay:FOLDER</source>
        <translation>Ein Gerät der Liste oder eine beliebige URI, z. B. replay:ORDNER</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>Show what the sensor sees</source>
        <translation>Zeigen, was der Sensor sieht</translation>
    </message>
    <message>
        <source>Filter points</source>
        <translation>Punkte filtern</translation>
    </message>
    <message>
        <source>Show only what stands on the turntable; needs a calibration</source>
        <translation>Nur zeigen, was auf dem Drehteller steht; benötigt eine Kalibrierung</translation>
    </message>
    <message>
        <source>Back to live</source>
        <translation>Zurück zur Live-Ansicht</translation>
    </message>
    <message>
        <source>Show what the sensor sees now</source>
        <translation>Zeigen, was der Sensor jetzt sieht</translation>
    </message>
    <message>
        <source>Not playing</source>
        <translation>Keine Anzeige</translation>
    </message>
    <message>
        <source>3  Recording</source>
        <translation>3  Aufnahme</translation>
    </message>
    <message>
        <source>Calibrate again</source>
        <translation>Neu kalibrieren</translation>
    </message>
    <message>
        <source>Take an averaged scan of the empty table, then press Calibrate</source>
        <translation>Einen gemittelten Scan des leeren Drehtellers aufnehmen, dann „Kalibrieren“ drücken</translation>
    </message>
    <message>
        <source>Use motion</source>
        <translation>Bewegung nutzen</translation>
    </message>
    <message>
        <source>Forget the calibration: the object&apos;s motion shows where the table is</source>
        <translation>Die Kalibrierung verwerfen: Die Bewegung des Objekts zeigt, wo der Drehteller steht</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, doll</source>
        <translation>Virtuelle Kinect v2, Puppe</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, letter A on a desk</source>
        <translation>Virtuelle Kinect v2, Buchstabe A auf einem Schreibtisch</translation>
    </message>
    <message>
        <source>Virtual Kinect v1, cylinder</source>
        <translation>Virtuelle Kinect v1, Zylinder</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, empty table on a desk</source>
        <translation>Virtuelle Kinect v2, leerer Drehteller auf einem Schreibtisch</translation>
    </message>
    <message>
        <source>Look for devices</source>
        <translation>Geräte suchen</translation>
    </message>
    <message>
        <source>Stopping</source>
        <translation>Wird gestoppt</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>%1 wird geöffnet</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 gespeichert</translation>
    </message>
    <message>
        <source>Averaging: %1 of %2 frames</source>
        <translation>Mittelung: %1 von %2 Bildern</translation>
    </message>
    <message>
        <source>click</source>
        <translation>Klick</translation>
    </message>
    <message>
        <source>2  Calibration</source>
        <translation>2  Kalibrierung</translation>
    </message>
    <message>
        <source>Averaged scan</source>
        <translation>Gemittelter Scan</translation>
    </message>
    <message>
        <source>Average frames of what stands still</source>
        <translation>Bilder von dem mitteln, was stillsteht</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Kalibrieren</translation>
    </message>
    <message>
        <source>Options</source>
        <translation>Optionen</translation>
    </message>
    <message>
        <source>Pick rim points</source>
        <translation>Randpunkte wählen</translation>
    </message>
    <message>
        <source>Click at least 3 points on the platter&apos;s rim</source>
        <translation>Mindestens 3 Punkte auf dem Rand des Drehtellers anklicken</translation>
    </message>
    <message>
        <source>Undo click</source>
        <translation>Klick zurück</translation>
    </message>
    <message>
        <source>Take back the last point (Ctrl+Z)</source>
        <translation>Den letzten Punkt zurücknehmen (Strg+Z)</translation>
    </message>
    <message>
        <source>Load…</source>
        <translation>Laden…</translation>
    </message>
    <message>
        <source>A calibration saved before</source>
        <translation>Eine früher gespeicherte Kalibrierung</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Speichern…</translation>
    </message>
    <message>
        <source>Keep the calibration as a file</source>
        <translation>Die Kalibrierung als Datei aufbewahren</translation>
    </message>
    <message>
        <source>Calibrations (*.json)</source>
        <translation>Kalibrierungen (*.json)</translation>
    </message>
    <message>
        <source>Load calibration</source>
        <translation>Kalibrierung laden</translation>
    </message>
    <message>
        <source>Save calibration</source>
        <translation>Kalibrierung speichern</translation>
    </message>
    <message>
        <source>Averaged %1 frames; noise of one frame %2</source>
        <translation>%1 Bilder gemittelt; Rauschen eines Bildes %2</translation>
    </message>
    <message>
        <source>%1. Pick points on the platter&apos;s rim instead.</source>
        <translation>%1. Wählen Sie stattdessen Punkte auf dem Rand des Drehtellers.</translation>
    </message>
    <message>
        <source>Click points on the rim of the platter, at least 3</source>
        <translation>Punkte auf dem Rand des Drehtellers anklicken, mindestens 3</translation>
    </message>
    <message>
        <source>%1 of at least 3 points</source>
        <translation>%1 von mindestens 3 Punkten</translation>
    </message>
    <message>
        <source>By %1: radius %2, error %3 (root mean square)</source>
        <translation>Durch %1: Radius %2, Fehler %3 (quadratisches Mittel)</translation>
    </message>
    <message>
        <source>
From the last recording with this device. Calibrate anew if sensor or table were moved since.</source>
        <translation>
Aus der letzten Aufnahme mit diesem Gerät. Neu kalibrieren, falls Sensor oder Drehteller seitdem bewegt wurden.</translation>
    </message>
    <message>
        <source>The calibration of the last recording is not used: %1</source>
        <translation>Die Kalibrierung der letzten Aufnahme wird nicht verwendet: %1</translation>
    </message>
    <message>
        <source>There is no calibration yet</source>
        <translation>Es gibt noch keine Kalibrierung</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>Gerät</translation>
    </message>
    <message>
        <source>Waiting for the first picture</source>
        <translation>Warten auf das erste Bild</translation>
    </message>
    <message>
        <source>The device says itself where its table stands.</source>
        <translation>Das Gerät gibt selbst an, wo sein Drehteller steht.</translation>
    </message>
    <message>
        <source>%1 frames a second, %2 points</source>
        <translation>%1 Bilder pro Sekunde, %2 Punkte</translation>
    </message>
    <message>
        <source>Find the turntable in an averaged scan, which is taken if there is none</source>
        <translation>Den Drehteller in einem gemittelten Scan suchen, der aufgenommen wird, falls keiner vorliegt</translation>
    </message>
    <message>
        <source>Correct</source>
        <translation>Korrigieren</translation>
    </message>
    <message>
        <source>The points are %1 off a circle (root mean square); %2 is the limit. Undo those that are not on the rim</source>
        <translation>Die Punkte liegen %1 neben einem Kreis (quadratisches Mittel); der Grenzwert ist %2. Nehmen Sie die zurück, die nicht auf dem Rand liegen</translation>
    </message>
    <message>
        <source>Platter: radius %1, known to %2</source>
        <translation>Drehteller: Radius %1, auf %2 bekannt</translation>
    </message>
    <message>
        <source>Platter: radius %1, how well is not known</source>
        <translation>Drehteller: Radius %1, Unsicherheit unbekannt</translation>
    </message>
    <message>
        <source>The platter is not where the calibration has it</source>
        <translation>Der Drehteller ist nicht dort, wo ihn die Kalibrierung angibt</translation>
    </message>
    <message>
        <source>No platter is seen; the object&apos;s motion will show where the table is</source>
        <translation>Kein Drehteller zu sehen; die Bewegung des Objekts wird zeigen, wo er steht</translation>
    </message>
    <message>
        <source>not known: 3 points fit any circle</source>
        <translation>unbekannt: 3 Punkte passen auf jeden Kreis</translation>
    </message>
    <message>
        <source>The detected platter differs by %1 in its centre, %2 in its radius</source>
        <translation>Der erkannte Drehteller weicht im Mittelpunkt um %1 ab, im Radius um %2</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SectionPanel</name>
    <message>
        <source>Section</source>
        <translation>Schnitt</translation>
    </message>
    <message>
        <source>Cut all models open by a plane, and close the selected one</source>
        <translation>Alle Modelle durch eine Ebene aufschneiden und das ausgewählte schließen</translation>
    </message>
    <message>
        <source>Export DXF…</source>
        <translation>DXF exportieren…</translation>
    </message>
    <message>
        <source>The contours as a drawing in millimetres</source>
        <translation>Die Konturen als Zeichnung in Millimetern</translation>
    </message>
    <message>
        <source>Export SVG…</source>
        <translation>SVG exportieren…</translation>
    </message>
    <message>
        <source>Drawing (*.dxf)</source>
        <translation>Zeichnung (*.dxf)</translation>
    </message>
    <message>
        <source>Drawing (*.svg)</source>
        <translation>Zeichnung (*.svg)</translation>
    </message>
    <message>
        <source>, %1 of them open: the mesh has holes there</source>
        <translation>, %1 davon offen: Das Netz hat dort Löcher</translation>
    </message>
    <message>
        <source>The plane does not meet the selected model</source>
        <translation>Die Ebene trifft das ausgewählte Modell nicht</translation>
    </message>
    <message>
        <source>%1 contours%2, area %3 cm², length %4 mm</source>
        <translation>%1 Konturen%2, Fläche %3 cm², Länge %4 mm</translation>
    </message>
    <message>
        <source>Export the section</source>
        <translation>Schnitt exportieren</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>%1 exportieren</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 gespeichert</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SessionKeeper</name>
    <message>
        <source>The session is not saved: %1 cannot be made</source>
        <translation>Die Sitzung wird nicht gespeichert: %1 kann nicht angelegt werden</translation>
    </message>
    <message>
        <source>The session is not saved: %1</source>
        <translation>Die Sitzung wird nicht gespeichert: %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SheetDialog</name>
    <message>
        <source>Stages</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>Save the stages</source>
        <translation>Schritte speichern</translation>
    </message>
    <message>
        <source>PNG (*.png)</source>
        <translation>PNG (*.png)</translation>
    </message>
    <message>
        <source>%1 cannot be written; check the folder and its permissions</source>
        <translation>%1 kann nicht geschrieben werden; prüfen Sie den Ordner und seine Zugriffsrechte</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SidePanel</name>
    <message>
        <source>Show what no view saw</source>
        <translation>Nicht Erfasstes zeigen</translation>
    </message>
    <message>
        <source>Surface that was closed without a measurement, in magenta</source>
        <translation>Oberfläche, die ohne Messung geschlossen wurde, in Magenta</translation>
    </message>
    <message>
        <source>Scan another side</source>
        <translation>Weitere Seite scannen</translation>
    </message>
    <message>
        <source>Lay the object another way and record it again; the passes become one mesh</source>
        <translation>Das Objekt anders hinlegen und erneut aufnehmen; aus den Durchgängen wird ein Netz</translation>
    </message>
    <message>
        <source>Select a mesh that was made from a recording: what no view saw of it, and how to lay it for the next pass, stands here.</source>
        <translation>Wählen Sie ein Netz, das aus einer Aufnahme entstanden ist: Hier steht dann, was keine Ansicht davon erfasst hat und wie das Objekt für den nächsten Durchgang liegen soll.</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SimulatorMode</name>
    <message>
        <source>Loading the object</source>
        <translation>Objekt wird geladen</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objekt</translation>
    </message>
    <message>
        <source>File…</source>
        <translation>Datei…</translation>
    </message>
    <message>
        <source>Any mesh: PLY, STL, OBJ, OFF, 3MF, GLB, …</source>
        <translation>Beliebiges Netz: PLY, STL, OBJ, OFF, 3MF, GLB, …</translation>
    </message>
    <message>
        <source>How it stands</source>
        <translation>Aufstellung</translation>
    </message>
    <message>
        <source>Object to scan</source>
        <translation>Zu scannendes Objekt</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>Szene</translation>
    </message>
    <message>
        <source>Load scene…</source>
        <translation>Szene laden…</translation>
    </message>
    <message>
        <source>A scene file, as turnscan simulate reads it</source>
        <translation>Eine Szenendatei, wie turnscan simulate sie liest</translation>
    </message>
    <message>
        <source>Save scene…</source>
        <translation>Szene speichern…</translation>
    </message>
    <message>
        <source>Everything here as a file for --scene</source>
        <translation>Alles hier als Datei für --scene</translation>
    </message>
    <message>
        <source>Scenes (*.toml)</source>
        <translation>Szenen (*.toml)</translation>
    </message>
    <message>
        <source>Load scene</source>
        <translation>Szene laden</translation>
    </message>
    <message>
        <source>Save scene</source>
        <translation>Szene speichern</translation>
    </message>
    <message>
        <source>Coverage</source>
        <translation>Abdeckung</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Folder to create for the recording; if it exists, it must be empty</source>
        <translation>Für die Aufnahme anzulegender Ordner; falls vorhanden, muss er leer sein</translation>
    </message>
    <message>
        <source>…</source>
        <translation>…</translation>
    </message>
    <message>
        <source>Choose the folder</source>
        <translation>Den Ordner wählen</translation>
    </message>
    <message>
        <source>Scan</source>
        <translation>Scannen</translation>
    </message>
    <message>
        <source>Record the object with all scanners</source>
        <translation>Das Objekt mit allen Scannern aufnehmen</translation>
    </message>
    <message>
        <source>Open in Explorer</source>
        <translation>Im Explorer öffnen</translation>
    </message>
    <message>
        <source>Load the recording in the Model Explorer</source>
        <translation>Die Aufnahme im Modell-Explorer laden</translation>
    </message>
    <message>
        <source>Reconstruct</source>
        <translation>Rekonstruieren</translation>
    </message>
    <message>
        <source>Load it there and run every stage</source>
        <translation>Dort laden und alle Schritte ausführen</translation>
    </message>
    <message>
        <source>Folder of the recording</source>
        <translation>Ordner der Aufnahme</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>Vorschau</translation>
    </message>
    <message>
        <source>There is no scanner; add one first</source>
        <translation>Kein Scanner vorhanden; zuerst einen hinzufügen</translation>
    </message>
    <message>
        <source>What was covered</source>
        <translation>Was abgedeckt wurde</translation>
    </message>
    <message>
        <source>Density of samples</source>
        <translation>Dichte der Messpunkte</translation>
    </message>
    <message>
        <source>Why it was missed</source>
        <translation>Warum es fehlt</translation>
    </message>
    <message>
        <source>The samples only</source>
        <translation>Nur die Messpunkte</translation>
    </message>
    <message>
        <source>Hole</source>
        <translation>Lücke</translation>
    </message>
    <message>
        <source>Size, mm</source>
        <translation>Größe, mm</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>The largest holes; click one to fly there.</source>
        <translation>Die größten Lücken; ein Klick führt dorthin.</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 gespeichert</translation>
    </message>
    <message>
        <source>%1 cm²</source>
        <translation>%1 cm²</translation>
    </message>
    <message>
        <source>Scanners</source>
        <translation>Scanner</translation>
    </message>
    <message>
        <source>Add scanner</source>
        <translation>Scanner hinzufügen</translation>
    </message>
    <message>
        <source>Matrix and line scanners from presets</source>
        <translation>Matrix- und Linienscanner aus Voreinstellungen</translation>
    </message>
    <message>
        <source>From file…</source>
        <translation>Aus Datei…</translation>
    </message>
    <message>
        <source>Scanner</source>
        <translation>Scanner</translation>
    </message>
    <message>
        <source>Scanners (*.toml)</source>
        <translation>Scanner (*.toml)</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Remove the selected scanner</source>
        <translation>Den ausgewählten Scanner entfernen</translation>
    </message>
    <message>
        <source>Drag a scanner in the view to move it, with Shift nearer or farther, or type its place:</source>
        <translation>Einen Scanner in der Ansicht ziehen, um ihn zu bewegen, mit Umschalt näher oder weiter weg, oder seine Position eingeben:</translation>
    </message>
    <message>
        <source>change of the rig</source>
        <translation>Änderung des Aufbaus</translation>
    </message>
    <message>
        <source>What the colours show</source>
        <translation>Was die Farben zeigen</translation>
    </message>
    <message>
        <source>The largest holes</source>
        <translation>Die größten Lücken</translation>
    </message>
    <message>
        <source>Sweep</source>
        <translation>Variation</translation>
    </message>
    <message>
        <source>Coverage of the selected scanner as it is turned:</source>
        <translation>Abdeckung des ausgewählten Scanners, wenn er gedreht wird:</translation>
    </message>
    <message>
        <source>The scanner that was swept is no longer there</source>
        <translation>Der variierte Scanner ist nicht mehr vorhanden</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::StagePanel</name>
    <message>
        <source>Reconstruct</source>
        <translation>Rekonstruieren</translation>
    </message>
    <message>
        <source>Run every stage on the selected recording or cloud (Ctrl+R)</source>
        <translation>Alle Schritte mit der ausgewählten Aufnahme oder Wolke ausführen (Strg+R)</translation>
    </message>
    <message>
        <source>Load preset…</source>
        <translation>Laden…</translation>
    </message>
    <message>
        <source>Options from a TOML file</source>
        <translation>Optionen aus einer TOML-Datei</translation>
    </message>
    <message>
        <source>Save preset…</source>
        <translation>Speichern…</translation>
    </message>
    <message>
        <source>Options as a TOML file for --config</source>
        <translation>Optionen als TOML-Datei für --config</translation>
    </message>
    <message>
        <source>Defaults</source>
        <translation>Standard</translation>
    </message>
    <message>
        <source>Set all options back</source>
        <translation>Alle Optionen zurücksetzen</translation>
    </message>
    <message>
        <source>Presets (*.toml)</source>
        <translation>Voreinstellungen (*.toml)</translation>
    </message>
    <message>
        <source>Load preset</source>
        <translation>Voreinstellung laden</translation>
    </message>
    <message>
        <source>Save preset</source>
        <translation>Voreinstellung speichern</translation>
    </message>
    <message>
        <source>Filter the cloud</source>
        <translation>Wolke filtern</translation>
    </message>
    <message>
        <source>Drop outliers of the selected cloud; adds a new model</source>
        <translation>Ausreißer der ausgewählten Wolke verwerfen; fügt ein neues Modell hinzu</translation>
    </message>
    <message>
        <source>Run the stages up to this one; adds its cloud as a new model</source>
        <translation>Die Schritte bis zu diesem ausführen; fügt dessen Wolke als neues Modell hinzu</translation>
    </message>
    <message>
        <source>Not at the defaults: %1. &lt;a href=&quot;reset&quot;&gt;Reset&lt;/a&gt;</source>
        <translation>Nicht auf Standard: %1. &lt;a href=&quot;reset&quot;&gt;Zurücksetzen&lt;/a&gt;</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SweepPanel</name>
    <message>
        <source>Sweep</source>
        <translation>Variieren</translation>
    </message>
    <message>
        <source>Find the coverage with each of the values</source>
        <translation>Die Abdeckung für jeden der Werte ermitteln</translation>
    </message>
    <message>
        <source>Use the best</source>
        <translation>Besten übernehmen</translation>
    </message>
    <message>
        <source>Place the scanner where it covers most</source>
        <translation>Den Scanner dorthin stellen, wo er am meisten abdeckt</translation>
    </message>
    <message>
        <source>Option to sweep</source>
        <translation>Zu variierende Option</translation>
    </message>
    <message>
        <source>Values: from..to/step</source>
        <translation>Werte: von..bis/Schritt</translation>
    </message>
    <message>
        <source>%1 at %2 covers most: %3 % of the surface</source>
        <translation>%1 bei %2 deckt am meisten ab: %3 % der Oberfläche</translation>
    </message>
    <message>
        <source>From, to and step in degrees, e.g. -45..45/15</source>
        <translation>Von, bis und Schritt in Grad, z. B. -45..45/15</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not from..to/step in degrees, e.g. -45..45/15</source>
        <translation>„%1“ ist nicht von..bis/Schritt in Grad, z. B. -45..45/15</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::TurntableMovie</name>
    <message>
        <source>The view was closed</source>
        <translation>Die Ansicht wurde geschlossen</translation>
    </message>
    <message>
        <source>%1 cannot be written</source>
        <translation>%1 kann nicht geschrieben werden</translation>
    </message>
    <message>
        <source>Picture %1 of %2</source>
        <translation>Bild %1 von %2</translation>
    </message>
    <message>
        <source>Make the film</source>
        <translation>Film erstellen</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::VerdictPanel</name>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Colours of the mesh</source>
        <translation>Farben des Netzes</translation>
    </message>
    <message>
        <source>What the colours of the selected mesh show</source>
        <translation>Was die Farben des ausgewählten Netzes zeigen</translation>
    </message>
    <message>
        <source>Export report…</source>
        <translation>Bericht…</translation>
    </message>
    <message>
        <source>One HTML file with the model in 3D, the verdict, pictures and plots</source>
        <translation>Eine HTML-Datei mit dem Modell in 3D, dem Urteil, Bildern und Diagrammen</translation>
    </message>
    <message>
        <source>Own colours</source>
        <translation>Eigene Farben</translation>
    </message>
    <message>
        <source>Select a mesh that was made from a recording: how good it is, and why, stands here. One that was edited, opened from a file or restored has no verdict; reconstruct its recording for one.</source>
        <translation>Wählen Sie ein Netz, das aus einer Aufnahme entstanden ist: Hier steht dann, wie gut es ist und warum. Für ein bearbeitetes, aus einer Datei geöffnetes oder wiederhergestelltes Netz gibt es kein Urteil; rekonstruieren Sie dafür seine Aufnahme.</translation>
    </message>
    <message>
        <source>Other findings</source>
        <translation>Weitere Befunde</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ViewPanel</name>
    <message>
        <source>Bounding boxes</source>
        <translation>Hüllquader</translation>
    </message>
    <message>
        <source>Draw the box around each model (B)</source>
        <translation>Den Quader um jedes Modell zeichnen (B)</translation>
    </message>
    <message>
        <source>How fast mouse and keys move the camera</source>
        <translation>Wie schnell Maus und Tasten die Kamera bewegen</translation>
    </message>
    <message>
        <source>Size of points on the screen</source>
        <translation>Größe der Punkte auf dem Bildschirm</translation>
    </message>
    <message>
        <source>Camera speed</source>
        <translation>Kameratempo</translation>
    </message>
    <message>
        <source>Point size</source>
        <translation>Punktgröße</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::VoxelPanel</name>
    <message>
        <source>As cubes</source>
        <translation>Als Würfel</translation>
    </message>
    <message>
        <source>Use for Voxelise</source>
        <translation>Beim Voxelisieren nutzen</translation>
    </message>
    <message>
        <source>Make this the option voxel-min-points of the next runs</source>
        <translation>Als Option voxel-min-points der nächsten Läufe verwenden</translation>
    </message>
    <message>
        <source>Least count of a cell that is shown</source>
        <translation>Mindestanzahl einer angezeigten Zelle</translation>
    </message>
    <message>
        <source>At least</source>
        <translation>Mindestens</translation>
    </message>
    <message>
        <source>%1 of %2 cells have at least %3 points</source>
        <translation>%1 von %2 Zellen haben mindestens %3 Punkte</translation>
    </message>
    <message>
        <source>Cubes</source>
        <translation>Würfel</translation>
    </message>
    <message>
        <source>Points in a cell</source>
        <translation>Punkte in einer Zelle</translation>
    </message>
    <message>
        <source> and more</source>
        <translation> und mehr</translation>
    </message>
    <message>
        <source>%1 of %2 cells have at least %3 lines</source>
        <translation>%1 von %2 Zellen haben mindestens %3 Linien</translation>
    </message>
    <message>
        <source>Lines through a cell</source>
        <translation>Linien durch eine Zelle</translation>
    </message>
</context>
</TS>
