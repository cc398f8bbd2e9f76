<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr_FR" sourcelanguage="en">
<context>
    <name>MessageLabel</name>
    <message>
        <source>Dismiss the message</source>
        <translation>Fermer le message</translation>
    </message>
</context>
<context>
    <name>Options</name>
    <message>
        <source>Aim height</source>
        <translation>Hauteur de visée</translation>
    </message>
    <message>
        <source>Aim x</source>
        <translation>Visée x</translation>
    </message>
    <message>
        <source>Aim z</source>
        <translation>Visée z</translation>
    </message>
    <message>
        <source>Albedo</source>
        <translation>Albédo</translation>
    </message>
    <message>
        <source>Align</source>
        <translation>Aligner</translation>
    </message>
    <message>
        <source>Alpha</source>
        <translation>Alpha</translation>
    </message>
    <message>
        <source>Angles</source>
        <translation>Angles</translation>
    </message>
    <message>
        <source>Average frames</source>
        <translation>Images moyennées</translation>
    </message>
    <message>
        <source>Average share</source>
        <translation>Part des images moyennées</translation>
    </message>
    <message>
        <source>Azimuth</source>
        <translation>Azimut</translation>
    </message>
    <message>
        <source>Base</source>
        <translation>Base</translation>
    </message>
    <message>
        <source>Border</source>
        <translation>Bord</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Étalonnage</translation>
    </message>
    <message>
        <source>Candidates</source>
        <translation>Candidats</translation>
    </message>
    <message>
        <source>Cloud outliers</source>
        <translation>Points aberrants du nuage</translation>
    </message>
    <message>
        <source>Clutter</source>
        <translation>Objets épars</translation>
    </message>
    <message>
        <source>Color files</source>
        <translation>Fichiers de couleur</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Couleur</translation>
    </message>
    <message>
        <source>Colour drift</source>
        <translation>Dérive de la couleur</translation>
    </message>
    <message>
        <source>Colour fov</source>
        <translation>Champ de vision couleur</translation>
    </message>
    <message>
        <source>Colour given shift</source>
        <translation>Décalage indiqué de la couleur</translation>
    </message>
    <message>
        <source>Colour given turn</source>
        <translation>Rotation indiquée de la couleur</translation>
    </message>
    <message>
        <source>Colour gloss</source>
        <translation>Brillance</translation>
    </message>
    <message>
        <source>Colour height</source>
        <translation>Hauteur de l’image couleur</translation>
    </message>
    <message>
        <source>Colour lamp</source>
        <translation>Lampe</translation>
    </message>
    <message>
        <source>Colour lamp azimuth</source>
        <translation>Azimut de la lampe</translation>
    </message>
    <message>
        <source>Colour lamp elevation</source>
        <translation>Élévation de la lampe</translation>
    </message>
    <message>
        <source>Colour noise</source>
        <translation>Bruit de la couleur</translation>
    </message>
    <message>
        <source>Colour pan</source>
        <translation>Rotation de la caméra couleur</translation>
    </message>
    <message>
        <source>Colour tilt</source>
        <translation>Inclinaison de la caméra couleur</translation>
    </message>
    <message>
        <source>Colour vignetting</source>
        <translation>Vignettage</translation>
    </message>
    <message>
        <source>Colour white drift</source>
        <translation>Dérive du blanc</translation>
    </message>
    <message>
        <source>Colour width</source>
        <translation>Largeur de l’image couleur</translation>
    </message>
    <message>
        <source>Colour x</source>
        <translation>Caméra couleur x</translation>
    </message>
    <message>
        <source>Colour y</source>
        <translation>Caméra couleur y</translation>
    </message>
    <message>
        <source>Colour z</source>
        <translation>Caméra couleur z</translation>
    </message>
    <message>
        <source>Coverage cell</source>
        <translation>Cellule de couverture</translation>
    </message>
    <message>
        <source>Coverage holes</source>
        <translation>Trous de couverture</translation>
    </message>
    <message>
        <source>Coverage thin</source>
        <translation>Couverture faible</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>Rognage</translation>
    </message>
    <message>
        <source>Crop below</source>
        <translation>Rognage au-dessous</translation>
    </message>
    <message>
        <source>Crop beyond</source>
        <translation>Rognage au-delà du bord</translation>
    </message>
    <message>
        <source>Crop height</source>
        <translation>Hauteur de rognage</translation>
    </message>
    <message>
        <source>Crop margin</source>
        <translation>Marge de rognage</translation>
    </message>
    <message>
        <source>Crop radius</source>
        <translation>Rayon de rognage</translation>
    </message>
    <message>
        <source>Cut plane</source>
        <translation>Plan de coupe</translation>
    </message>
    <message>
        <source>Device timeout</source>
        <translation>Délai de l’appareil</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Distance</translation>
    </message>
    <message>
        <source>Dropped</source>
        <translation>Images perdues</translation>
    </message>
    <message>
        <source>Edge fattening</source>
        <translation>Épaississement des bords</translation>
    </message>
    <message>
        <source>Elevation</source>
        <translation>Élévation</translation>
    </message>
    <message>
        <source>Exposure</source>
        <translation>Exposition</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Ajustement</translation>
    </message>
    <message>
        <source>Fit iterations</source>
        <translation>Itérations d’ajustement</translation>
    </message>
    <message>
        <source>Fit reach</source>
        <translation>Portée de l’ajustement</translation>
    </message>
    <message>
        <source>Foot</source>
        <translation>Pied</translation>
    </message>
    <message>
        <source>Fps</source>
        <translation>Images par seconde</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Images</translation>
    </message>
    <message>
        <source>Gauge ball</source>
        <translation>Sphère étalon</translation>
    </message>
    <message>
        <source>Halt</source>
        <translation>Arrêt</translation>
    </message>
    <message>
        <source>Halt at</source>
        <translation>Instant de l’arrêt</translation>
    </message>
    <message>
        <source>Hand</source>
        <translation>Main</translation>
    </message>
    <message>
        <source>Hand at</source>
        <translation>Instant de la main</translation>
    </message>
    <message>
        <source>Hand direction</source>
        <translation>Direction de la main</translation>
    </message>
    <message>
        <source>Hand height</source>
        <translation>Hauteur de la main</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Hauteur</translation>
    </message>
    <message>
        <source>Hole size</source>
        <translation>Taille des trous</translation>
    </message>
    <message>
        <source>Holes</source>
        <translation>Trous</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Conserver</translation>
    </message>
    <message>
        <source>Keep box</source>
        <translation>Boîte à conserver</translation>
    </message>
    <message>
        <source>Knock</source>
        <translation>Choc</translation>
    </message>
    <message>
        <source>Knock at</source>
        <translation>Instant du choc</translation>
    </message>
    <message>
        <source>Knock direction</source>
        <translation>Direction du choc</translation>
    </message>
    <message>
        <source>Knock pan</source>
        <translation>Rotation due au choc</translation>
    </message>
    <message>
        <source>Knock tilt</source>
        <translation>Inclinaison due au choc</translation>
    </message>
    <message>
        <source>Lean</source>
        <translation>Inclinaison</translation>
    </message>
    <message>
        <source>Mark invented</source>
        <translation>Marquer l’inventé</translation>
    </message>
    <message>
        <source>Max error</source>
        <translation>Erreur max.</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Méthode</translation>
    </message>
    <message>
        <source>Min free</source>
        <translation>Espace libre min. (octets)</translation>
    </message>
    <message>
        <source>Min object share</source>
        <translation>Part min. d’un objet</translation>
    </message>
    <message>
        <source>Mixed pixels</source>
        <translation>Pixels mixtes</translation>
    </message>
    <message>
        <source>Mixed reach</source>
        <translation>Portée des pixels mixtes</translation>
    </message>
    <message>
        <source>Motion angle sigma</source>
        <translation>Mouvement, sigma des angles</translation>
    </message>
    <message>
        <source>Motion angles</source>
        <translation>Mouvement, angles</translation>
    </message>
    <message>
        <source>Motion keys</source>
        <translation>Mouvement, images clés</translation>
    </message>
    <message>
        <source>Motion table</source>
        <translation>Mouvement, plateau</translation>
    </message>
    <message>
        <source>Motor baud</source>
        <translation>Débit du moteur (bauds)</translation>
    </message>
    <message>
        <source>Motor boot</source>
        <translation>Démarrage de la carte</translation>
    </message>
    <message>
        <source>Motor max speed</source>
        <translation>Vitesse max. du moteur</translation>
    </message>
    <message>
        <source>Motor protocol</source>
        <translation>Protocole du moteur</translation>
    </message>
    <message>
        <source>Motor reversed</source>
        <translation>Moteur inversé</translation>
    </message>
    <message>
        <source>Motor timeout</source>
        <translation>Délai du moteur</translation>
    </message>
    <message>
        <source>Motor units</source>
        <translation>Unités du moteur</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Bruit</translation>
    </message>
    <message>
        <source>Noise window</source>
        <translation>Fenêtre du bruit</translation>
    </message>
    <message>
        <source>Normal radius</source>
        <translation>Rayon des normales</translation>
    </message>
    <message>
        <source>Object gap</source>
        <translation>Distance entre objets</translation>
    </message>
    <message>
        <source>Object move</source>
        <translation>Déplacement de l’objet</translation>
    </message>
    <message>
        <source>Object move at</source>
        <translation>Instant du déplacement</translation>
    </message>
    <message>
        <source>Object move direction</source>
        <translation>Direction du déplacement</translation>
    </message>
    <message>
        <source>Object move tip</source>
        <translation>Basculement au déplacement</translation>
    </message>
    <message>
        <source>Object move turn</source>
        <translation>Rotation au déplacement</translation>
    </message>
    <message>
        <source>Object x</source>
        <translation>Objet x</translation>
    </message>
    <message>
        <source>Object z</source>
        <translation>Objet z</translation>
    </message>
    <message>
        <source>Only object</source>
        <translation>Seulement l’objet n°</translation>
    </message>
    <message>
        <source>Outlier k</source>
        <translation>Points aberrants, voisins</translation>
    </message>
    <message>
        <source>Outlier lambda</source>
        <translation>Points aberrants, lambda</translation>
    </message>
    <message>
        <source>Outliers</source>
        <translation>Points aberrants</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Recouvrement</translation>
    </message>
    <message>
        <source>Pass</source>
        <translation>Passe</translation>
    </message>
    <message>
        <source>Platter</source>
        <translation>Plateau</translation>
    </message>
    <message>
        <source>Platter confidence</source>
        <translation>Confiance du plateau</translation>
    </message>
    <message>
        <source>Platter max radius</source>
        <translation>Rayon max. du plateau</translation>
    </message>
    <message>
        <source>Platter min radius</source>
        <translation>Rayon min. du plateau</translation>
    </message>
    <message>
        <source>Platter radius</source>
        <translation>Rayon du plateau</translation>
    </message>
    <message>
        <source>Platter rim</source>
        <translation>Bord du plateau</translation>
    </message>
    <message>
        <source>Platter thickness</source>
        <translation>Épaisseur du plateau</translation>
    </message>
    <message>
        <source>Poisson depth</source>
        <translation>Profondeur de Poisson</translation>
    </message>
    <message>
        <source>Poisson point weight</source>
        <translation>Poids des points (Poisson)</translation>
    </message>
    <message>
        <source>Poisson samples</source>
        <translation>Échantillons de Poisson</translation>
    </message>
    <message>
        <source>Poisson scale</source>
        <translation>Échelle de Poisson</translation>
    </message>
    <message>
        <source>Record queue</source>
        <translation>File d’enregistrement</translation>
    </message>
    <message>
        <source>Record threads</source>
        <translation>Threads d’enregistrement</translation>
    </message>
    <message>
        <source>Refine</source>
        <translation>Affiner</translation>
    </message>
    <message>
        <source>Refine colour camera</source>
        <translation>Affiner la caméra couleur</translation>
    </message>
    <message>
        <source>Refine iterations</source>
        <translation>Itérations d’affinage</translation>
    </message>
    <message>
        <source>Refine radius</source>
        <translation>Rayon d’affinage</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Réparer</translation>
    </message>
    <message>
        <source>Ripple</source>
        <translation>Ondulation de vitesse</translation>
    </message>
    <message>
        <source>Ripple cycles</source>
        <translation>Cycles d’ondulation</translation>
    </message>
    <message>
        <source>Roll</source>
        <translation>Roulis</translation>
    </message>
    <message>
        <source>Room</source>
        <translation>Environnement</translation>
    </message>
    <message>
        <source>Runout</source>
        <translation>Faux-rond</translation>
    </message>
    <message>
        <source>Runout cycles</source>
        <translation>Cycles du faux-rond</translation>
    </message>
    <message>
        <source>Sample seed</source>
        <translation>Graine du tirage</translation>
    </message>
    <message>
        <source>Samples</source>
        <translation>Échantillons</translation>
    </message>
    <message>
        <source>Scan colour</source>
        <translation>Numériser la couleur</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>Secondes</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Graine</translation>
    </message>
    <message>
        <source>Settle</source>
        <translation>Stabilisation</translation>
    </message>
    <message>
        <source>Sharpen</source>
        <translation>Accentuer</translation>
    </message>
    <message>
        <source>Slip</source>
        <translation>Glissement</translation>
    </message>
    <message>
        <source>Slip at</source>
        <translation>Instant du glissement</translation>
    </message>
    <message>
        <source>Smallest part</source>
        <translation>Plus petite partie</translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation>Lissage</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Vitesse</translation>
    </message>
    <message>
        <source>Start delay</source>
        <translation>Délai de démarrage</translation>
    </message>
    <message>
        <source>Start ramp</source>
        <translation>Rampe de démarrage</translation>
    </message>
    <message>
        <source>Stop frames</source>
        <translation>Images par arrêt</translation>
    </message>
    <message>
        <source>Stop ramp</source>
        <translation>Rampe d’arrêt</translation>
    </message>
    <message>
        <source>Stops</source>
        <translation>Arrêts</translation>
    </message>
    <message>
        <source>Sub voxel line</source>
        <translation>Ligne des sous-voxels</translation>
    </message>
    <message>
        <source>Sub voxels</source>
        <translation>Sous-voxels</translation>
    </message>
    <message>
        <source>Table tilt</source>
        <translation>Inclinaison du plateau</translation>
    </message>
    <message>
        <source>Table tilt direction</source>
        <translation>Direction de l’inclinaison</translation>
    </message>
    <message>
        <source>Table x</source>
        <translation>Plateau x</translation>
    </message>
    <message>
        <source>Table y</source>
        <translation>Plateau y</translation>
    </message>
    <message>
        <source>Table z</source>
        <translation>Plateau z</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Texture</translation>
    </message>
    <message>
        <source>Texture size</source>
        <translation>Taille de la texture</translation>
    </message>
    <message>
        <source>Thresholds</source>
        <translation>Seuils</translation>
    </message>
    <message>
        <source>Tip</source>
        <translation>Basculement</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>Tolérance</translation>
    </message>
    <message>
        <source>Travel</source>
        <translation>Course</translation>
    </message>
    <message>
        <source>Travel along</source>
        <translation>Direction de la course</translation>
    </message>
    <message>
        <source>Triangles</source>
        <translation>Triangles</translation>
    </message>
    <message>
        <source>Truncation</source>
        <translation>Troncature</translation>
    </message>
    <message>
        <source>Turns</source>
        <translation>Tours</translation>
    </message>
    <message>
        <source>Until stopped</source>
        <translation>Jusqu’à l’arrêt</translation>
    </message>
    <message>
        <source>Voxel grid</source>
        <translation>Grille de voxels</translation>
    </message>
    <message>
        <source>Voxel min points</source>
        <translation>Points min. par voxel</translation>
    </message>
    <message>
        <source>Voxel size</source>
        <translation>Taille de voxel</translation>
    </message>
    <message>
        <source>Warm up</source>
        <translation>Échauffement</translation>
    </message>
    <message>
        <source>Warm up time</source>
        <translation>Durée d’échauffement</translation>
    </message>
    <message>
        <source>Wiggling</source>
        <translation>Erreur cyclique</translation>
    </message>
    <message>
        <source>Wiggling period</source>
        <translation>Période de l’erreur cyclique</translation>
    </message>
    <message>
        <source>Wobble</source>
        <translation>Voile</translation>
    </message>
    <message>
        <source>Wobble cycles</source>
        <translation>Cycles du voile</translation>
    </message>
    <message>
        <source>Yaw</source>
        <translation>Rotation</translation>
    </message>
    <message>
        <source>Ball</source>
        <translation>Sphère</translation>
    </message>
    <message>
        <source>Ball bar</source>
        <translation>Barre à sphères</translation>
    </message>
    <message>
        <source>Colour camera</source>
        <translation>Caméra couleur</translation>
    </message>
    <message>
        <source>Covered</source>
        <translation>Couvert</translation>
    </message>
    <message>
        <source>Cylinder</source>
        <translation>Cylindre</translation>
    </message>
    <message>
        <source>Doll</source>
        <translation>Poupée</translation>
    </message>
    <message>
        <source>Emitter blocked</source>
        <translation>Émetteur masqué</translation>
    </message>
    <message>
        <source>Grazing</source>
        <translation>Rasant</translation>
    </message>
    <message>
        <source>Letter a</source>
        <translation>Lettre A</translation>
    </message>
    <message>
        <source>Missed</source>
        <translation>Manqué</translation>
    </message>
    <message>
        <source>Motion of the turntable</source>
        <translation>Mouvement du plateau tournant</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Aucune</translation>
    </message>
    <message>
        <source>Nothing</source>
        <translation>Rien</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objet</translation>
    </message>
    <message>
        <source>Out of view</source>
        <translation>Hors du champ</translation>
    </message>
    <message>
        <source>Place of the scanners</source>
        <translation>Position des scanners</translation>
    </message>
    <message>
        <source>Plate</source>
        <translation>Plaque</translation>
    </message>
    <message>
        <source>Receiver blocked</source>
        <translation>Récepteur masqué</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Enregistrement</translation>
    </message>
    <message>
        <source>Rejected</source>
        <translation>Rejeté</translation>
    </message>
    <message>
        <source>Scorpion</source>
        <translation>Scorpion</translation>
    </message>
    <message>
        <source>Skull</source>
        <translation>Crâne</translation>
    </message>
    <message>
        <source>Thin</source>
        <translation>Faible</translation>
    </message>
    <message>
        <source>Too dark</source>
        <translation>Trop sombre</translation>
    </message>
    <message>
        <source>Too far</source>
        <translation>Trop loin</translation>
    </message>
    <message>
        <source>Too near</source>
        <translation>Trop près</translation>
    </message>
    <message>
        <source>Turntable</source>
        <translation>Plateau tournant</translation>
    </message>
    <message>
        <source>Unreachable</source>
        <translation>Inaccessible</translation>
    </message>
    <message>
        <source>Events during the recording</source>
        <translation>Événements pendant l’enregistrement</translation>
    </message>
    <message>
        <source>Color quality</source>
        <translation>Qualité de la couleur</translation>
    </message>
    <message>
        <source>Labelled cylinder</source>
        <translation>Cylindre étiqueté</translation>
    </message>
    <message>
        <source>Action figure</source>
        <translation>Figurine</translation>
    </message>
    <message>
        <source>Aspect</source>
        <translation>Rapport largeur/hauteur</translation>
    </message>
    <message>
        <source>Axial constant</source>
        <translation>Axial, constant</translation>
    </message>
    <message>
        <source>Axial grazing</source>
        <translation>Axial, rasant</translation>
    </message>
    <message>
        <source>Axial grazing from</source>
        <translation>Axial, rasant dès</translation>
    </message>
    <message>
        <source>Axial grazing power</source>
        <translation>Axial, rasant, exposant</translation>
    </message>
    <message>
        <source>Axial linear</source>
        <translation>Axial, linéaire</translation>
    </message>
    <message>
        <source>Axial linear from</source>
        <translation>Axial, linéaire dès</translation>
    </message>
    <message>
        <source>Axial quadratic</source>
        <translation>Axial, quadratique</translation>
    </message>
    <message>
        <source>Axial quadratic at</source>
        <translation>Axial, quadratique à</translation>
    </message>
    <message>
        <source>Baseline</source>
        <translation>Ligne de base</translation>
    </message>
    <message>
        <source>Baseline direction</source>
        <translation>Direction de la ligne de base</translation>
    </message>
    <message>
        <source>Bias</source>
        <translation>Biais</translation>
    </message>
    <message>
        <source>Colour delay</source>
        <translation>Retard de la couleur</translation>
    </message>
    <message>
        <source>Colour jitter</source>
        <translation>Gigue de la couleur</translation>
    </message>
    <message>
        <source>Columns</source>
        <translation>Colonnes</translation>
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
        <translation>Fluctuation du signal sombre</translation>
    </message>
    <message>
        <source>Dark signal</source>
        <translation>Signal sombre</translation>
    </message>
    <message>
        <source>Depth unit</source>
        <translation>Unité de profondeur</translation>
    </message>
    <message>
        <source>Disparity sigma</source>
        <translation>Disparité, sigma</translation>
    </message>
    <message>
        <source>Disparity step</source>
        <translation>Disparité, pas</translation>
    </message>
    <message>
        <source>Drop from</source>
        <translation>Perte dès</translation>
    </message>
    <message>
        <source>Drop to</source>
        <translation>Perte totale dès</translation>
    </message>
    <message>
        <source>Far</source>
        <translation>Distance max.</translation>
    </message>
    <message>
        <source>Footprint px</source>
        <translation>Empreinte, px</translation>
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
        <translation>Type</translation>
    </message>
    <message>
        <source>Lateral grazing px</source>
        <translation>Latéral, rasant, px</translation>
    </message>
    <message>
        <source>Lateral length</source>
        <translation>Latéral, longueur</translation>
    </message>
    <message>
        <source>Lateral per metre</source>
        <translation>Latéral par mètre</translation>
    </message>
    <message>
        <source>Lateral px</source>
        <translation>Latéral, px</translation>
    </message>
    <message>
        <source>Line aperture</source>
        <translation>Ligne, ouverture</translation>
    </message>
    <message>
        <source>Line blur</source>
        <translation>Ligne, flou</translation>
    </message>
    <message>
        <source>Line contrast</source>
        <translation>Ligne, contraste</translation>
    </message>
    <message>
        <source>Line exposure</source>
        <translation>Ligne, exposition</translation>
    </message>
    <message>
        <source>Line focal</source>
        <translation>Ligne, focale</translation>
    </message>
    <message>
        <source>Line full well</source>
        <translation>Ligne, capacité du pixel</translation>
    </message>
    <message>
        <source>Line read noise</source>
        <translation>Ligne, bruit de lecture</translation>
    </message>
    <message>
        <source>Line threshold</source>
        <translation>Ligne, seuil</translation>
    </message>
    <message>
        <source>Line wavelength</source>
        <translation>Ligne, longueur d’onde</translation>
    </message>
    <message>
        <source>Line width</source>
        <translation>Ligne, largeur</translation>
    </message>
    <message>
        <source>Max incidence</source>
        <translation>Incidence max.</translation>
    </message>
    <message>
        <source>Mixed rejection</source>
        <translation>Rejet des pixels mixtes</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nom</translation>
    </message>
    <message>
        <source>Near</source>
        <translation>Distance min.</translation>
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
        <translation>Rotation à droite</translation>
    </message>
    <message>
        <source>Physics</source>
        <translation>Physique</translation>
    </message>
    <message>
        <source>Robed figure</source>
        <translation>Personnage drapé</translation>
    </message>
    <message>
        <source>Rows</source>
        <translation>Lignes</translation>
    </message>
    <message>
        <source>Sensing</source>
        <translation>Mesure</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Inclinaison vers le haut</translation>
    </message>
    <message>
        <source>Tof amplitude</source>
        <translation>ToF, amplitude</translation>
    </message>
    <message>
        <source>Tof read noise</source>
        <translation>ToF, bruit de lecture</translation>
    </message>
    <message>
        <source>Tof relative noise</source>
        <translation>ToF, bruit relatif</translation>
    </message>
    <message>
        <source>Tof shot noise</source>
        <translation>ToF, bruit de grenaille</translation>
    </message>
    <message>
        <source>Vertical fov</source>
        <translation>Champ de vision vertical</translation>
    </message>
    <message>
        <source>Voxel grid in bounds</source>
        <translation>Grille dans la boîte des points</translation>
    </message>
    <message>
        <source>Window agreement</source>
        <translation>Fenêtre, concordance</translation>
    </message>
    <message>
        <source>Window dots</source>
        <translation>Fenêtre, points</translation>
    </message>
    <message>
        <source>Window px</source>
        <translation>Fenêtre, px</translation>
    </message>
    <message>
        <source>Window share</source>
        <translation>Fenêtre, proportion</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>Error, mm</source>
        <translation>Erreur, mm</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>moyenne</translation>
    </message>
    <message>
        <source>median</source>
        <translation>médiane</translation>
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
        <translation>Exactitude</translation>
    </message>
    <message>
        <source>Completeness</source>
        <translation>Complétude</translation>
    </message>
    <message>
        <source>Within</source>
        <translation>À moins de</translation>
    </message>
    <message>
        <source>precision</source>
        <translation>précision</translation>
    </message>
    <message>
        <source>recall</source>
        <translation>rappel</translation>
    </message>
    <message>
        <source>distance to %1</source>
        <translation>distance à %1</translation>
    </message>
    <message>
        <source>Millimetres</source>
        <translation>Millimètres</translation>
    </message>
    <message>
        <source>Centimetres</source>
        <translation>Centimètres</translation>
    </message>
    <message>
        <source>Inches</source>
        <translation>Pouces</translation>
    </message>
    <message>
        <source>Metres</source>
        <translation>Mètres</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
    <message>
        <source>Which unit?</source>
        <translation>Quelle unité ?</translation>
    </message>
    <message>
        <source>%1 does not say its unit. Read in %2 it is %3 large. In which unit is it?</source>
        <translation>%1 n’indique pas son unité. Lu en %2, il mesure %3. Dans quelle unité est-il ?</translation>
    </message>
    <message>
        <source>Distance to %1</source>
        <translation>Distance à %1</translation>
    </message>
    <message>
        <source> and more</source>
        <translation> et plus</translation>
    </message>
    <message>
        <source>empty</source>
        <translation>vide</translation>
    </message>
    <message>
        <source>%1 vertices, %2 triangles in %3
%4
Area %5 cm²</source>
        <translation>%1 sommets, %2 triangles en %3
%4
Aire %5 cm²</translation>
    </message>
    <message>
        <source>1 piece</source>
        <translation>1 morceau</translation>
    </message>
    <message>
        <source>%1 pieces</source>
        <translation>%1 morceaux</translation>
    </message>
    <message>
        <source>
Texture of %1 × %2 texels</source>
        <translation>
Texture de %1 × %2 texels</translation>
    </message>
    <message>
        <source>, volume %1 cm³</source>
        <translation>, volume %1 cm³</translation>
    </message>
    <message>
        <source>%1 points%2%3
%4</source>
        <translation>%1 points%2%3
%4</translation>
    </message>
    <message>
        <source>, with normals</source>
        <translation>, avec normales</translation>
    </message>
    <message>
        <source>, with colours</source>
        <translation>, avec couleurs</translation>
    </message>
    <message>
        <source>%1 triangles</source>
        <translation>%1 triangles</translation>
    </message>
    <message>
        <source>%1 points</source>
        <translation>%1 points</translation>
    </message>
    <message>
        <source>%1 frames</source>
        <translation>%1 images</translation>
    </message>
    <message>
        <source>View of each place</source>
        <translation>Vue de chaque endroit</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>Rognage</translation>
    </message>
    <message>
        <source>Statistical filter</source>
        <translation>Filtre statistique</translation>
    </message>
    <message>
        <source>Merge</source>
        <translation>Fusion</translation>
    </message>
    <message>
        <source>Voxelisation</source>
        <translation>Voxélisation</translation>
    </message>
    <message>
        <source>Candidate points</source>
        <translation>Points candidats</translation>
    </message>
    <message>
        <source>Objects</source>
        <translation>Objets</translation>
    </message>
    <message>
        <source>Normals</source>
        <translation>Normales</translation>
    </message>
    <message>
        <source>Refinement</source>
        <translation>Affinage</translation>
    </message>
    <message>
        <source>Base</source>
        <translation>Base</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Maillage</translation>
    </message>
    <message>
        <source>Volumetric mesh</source>
        <translation>Maillage volumétrique</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>Finition</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Texture</translation>
    </message>
    <message>
        <source>Merge the frames</source>
        <translation>Fusionner les images</translation>
    </message>
    <message>
        <source>Voxelise</source>
        <translation>Voxéliser</translation>
    </message>
    <message>
        <source>Find candidates</source>
        <translation>Chercher les candidats</translation>
    </message>
    <message>
        <source>Refine candidates</source>
        <translation>Affiner les candidats</translation>
    </message>
    <message>
        <source>Oriented points</source>
        <translation>Points orientés</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 de %2</translation>
    </message>
    <message>
        <source>%1 mesh</source>
        <translation>maillage de %1</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>%1 was not joined: %2; its mesh is a model of its own</source>
        <translation>%1 n’a pas été assemblée : %2 ; son maillage forme un modèle à part</translation>
    </message>
    <message>
        <source>
Note: %1</source>
        <translation>
Note : %1</translation>
    </message>
    <message>
        <source>%1 of %2 points were dropped</source>
        <translation>%1 points sur %2 ont été écartés</translation>
    </message>
    <message>
        <source>filter of %1</source>
        <translation>filtre de %1</translation>
    </message>
    <message>
        <source>frame %1, from %2°: %3 %</source>
        <translation>image %1, depuis %2° : %3 %</translation>
    </message>
    <message>
        <source>no view, filled: %1 %</source>
        <translation>sans vue, rempli : %1 %</translation>
    </message>
    <message>
        <source>Above the plane</source>
        <translation>Au-dessus du plan</translation>
    </message>
    <message>
        <source>Seen from</source>
        <translation>Vu depuis</translation>
    </message>
    <message>
        <source>1 side</source>
        <translation>1 côté</translation>
    </message>
    <message>
        <source>2 sides</source>
        <translation>2 côtés</translation>
    </message>
    <message>
        <source>%1 or more</source>
        <translation>%1 ou plus</translation>
    </message>
    <message>
        <source>nowhere yet</source>
        <translation>encore aucun</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>inconnu</translation>
    </message>
    <message>
        <source>Share of the surface</source>
        <translation>Part de la surface</translation>
    </message>
    <message>
        <source>Samples per mm²</source>
        <translation>Échantillons par mm²</translation>
    </message>
    <message>
        <source>Without a sample</source>
        <translation>Sans échantillon</translation>
    </message>
    <message>
        <source>Has samples</source>
        <translation>Avec échantillons</translation>
    </message>
    <message>
        <source>Rig</source>
        <translation>Montage</translation>
    </message>
    <message>
        <source>View of a scanner</source>
        <translation>Champ d’un scanner</translation>
    </message>
    <message>
        <source>Emitter</source>
        <translation>Émetteur</translation>
    </message>
    <message>
        <source>Receiver</source>
        <translation>Récepteur</translation>
    </message>
    <message>
        <source>Rim, and the way it turns</source>
        <translation>Bord et sens de rotation</translation>
    </message>
    <message>
        <source>Front	1</source>
        <translation>Face	1</translation>
    </message>
    <message>
        <source>Back	2</source>
        <translation>Arrière	2</translation>
    </message>
    <message>
        <source>Left	3</source>
        <translation>Gauche	3</translation>
    </message>
    <message>
        <source>Right	4</source>
        <translation>Droite	4</translation>
    </message>
    <message>
        <source>Top	5</source>
        <translation>Dessus	5</translation>
    </message>
    <message>
        <source>Bottom	6</source>
        <translation>Dessous	6</translation>
    </message>
    <message>
        <source>Corner	7</source>
        <translation>Coin	7</translation>
    </message>
    <message>
        <source>Reset camera</source>
        <translation>Tout cadrer</translation>
    </message>
    <message>
        <source>Show everything (Home)</source>
        <translation>Tout afficher (Début)</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Vues</translation>
    </message>
    <message>
        <source>Look from one side (1 to 7)</source>
        <translation>Regarder d’un côté (1 à 7)</translation>
    </message>
    <message>
        <source>&lt;br&gt;From %1 to %2</source>
        <translation>&lt;br&gt;De %1 à %2</translation>
    </message>
    <message>
        <source>%1 s left</source>
        <translation>encore %1 s</translation>
    </message>
    <message>
        <source>%1 min %2 s left</source>
        <translation>encore %1 min %2 s</translation>
    </message>
    <message>
        <source>Quit?</source>
        <translation>Quitter ?</translation>
    </message>
    <message>
        <source>Quit without saving</source>
        <translation>Quitter sans sauvegarder</translation>
    </message>
    <message>
        <source>Stay</source>
        <translation>Rester</translation>
    </message>
    <message>
        <source>%1, %2 dropped</source>
        <translation>%1, %2 perdues</translation>
    </message>
    <message>
        <source>Probe</source>
        <translation>Sonde</translation>
    </message>
    <message>
        <source>The deviation from the reference at a place</source>
        <translation>L’écart à la référence en un point</translation>
    </message>
    <message>
        <source>Click on a model whose deviations are shown</source>
        <translation>Cliquez sur un modèle dont les écarts sont affichés</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Distance</translation>
    </message>
    <message>
        <source>Distance between two places</source>
        <translation>Distance entre deux points</translation>
    </message>
    <message>
        <source>Click two places on models</source>
        <translation>Cliquez sur deux points des modèles</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Angle</translation>
    </message>
    <message>
        <source>Angle at a corner between the directions to two places</source>
        <translation>Angle, en un sommet, entre les directions de deux points</translation>
    </message>
    <message>
        <source>Click a place, the corner, and another place</source>
        <translation>Cliquez sur un point, sur le sommet, puis sur un autre point</translation>
    </message>
    <message>
        <source>Circle</source>
        <translation>Cercle</translation>
    </message>
    <message>
        <source>Diameter of the circle through three places</source>
        <translation>Diamètre du cercle passant par trois points</translation>
    </message>
    <message>
        <source>Click three places on the circle</source>
        <translation>Cliquez sur trois points du cercle</translation>
    </message>
    <message>
        <source>Plane</source>
        <translation>Plan</translation>
    </message>
    <message>
        <source>How flat the surface around a place is</source>
        <translation>Planéité de la surface autour d’un point</translation>
    </message>
    <message>
        <source>Click on a flat part of the selected model</source>
        <translation>Cliquez sur une partie plane du modèle sélectionné</translation>
    </message>
    <message>
        <source>Thickness</source>
        <translation>Épaisseur</translation>
    </message>
    <message>
        <source>Thickness of the wall behind a place, perpendicular to it</source>
        <translation>Épaisseur de la paroi derrière un point, perpendiculairement</translation>
    </message>
    <message>
        <source>Click on the selected model</source>
        <translation>Cliquez sur le modèle sélectionné</translation>
    </message>
    <message>
        <source>
The command line makes it with%1 --refine-pass-poses</source>
        <translation>
La ligne de commande le fait avec%1 --refine-pass-poses</translation>
    </message>
    <message>
        <source>pass %1: %2</source>
        <translation>passe %1 : %2</translation>
    </message>
    <message>
        <source>%1 of pass %2</source>
        <translation>%1 de la passe %2</translation>
    </message>
    <message>
        <source>Not measured</source>
        <translation>Non mesuré</translation>
    </message>
    <message>
        <source>no view saw it</source>
        <translation>vu par aucune vue</translation>
    </message>
    <message>
        <source>Nearly all of its surface was seen.</source>
        <translation>Presque toute sa surface a été vue.</translation>
    </message>
    <message>
        <source>Count contributions</source>
        <translation>Compter les contributions</translation>
    </message>
    <message>
        <source>Put nothing on the table and press Calibrate; or record at once: the object&apos;s motion shows where the table is.</source>
        <translation>Laissez le plateau vide et cliquez sur Étalonner ; ou enregistrez tout de suite : le mouvement de l’objet montre où est le plateau.</translation>
    </message>
    <message>
        <source>%1 %2 (default %3)</source>
        <translation>%1 %2 (par défaut %3)</translation>
    </message>
    <message>
        <source>Made with the defaults</source>
        <translation>Fait avec les valeurs par défaut</translation>
    </message>
    <message>
        <source>Made with</source>
        <translation>Fait avec</translation>
    </message>
    <message>
        <source>
Found from the data</source>
        <translation>
Tiré des données</translation>
    </message>
    <message>
        <source>
Edited or duplicated since</source>
        <translation>
Modifié ou dupliqué depuis</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ComparePanel</name>
    <message>
        <source>Options of distances</source>
        <translation>Options des distances</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Référence</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modèle</translation>
    </message>
    <message>
        <source>Side by side</source>
        <translation>Côte à côte</translation>
    </message>
    <message>
        <source>Both with one camera</source>
        <translation>Les deux avec une seule caméra</translation>
    </message>
    <message>
        <source>Overlay</source>
        <translation>Superposer</translation>
    </message>
    <message>
        <source>One over the other</source>
        <translation>L’un sur l’autre</translation>
    </message>
    <message>
        <source>Distances</source>
        <translation>Distances</translation>
    </message>
    <message>
        <source>Colour the model by its distance to the reference</source>
        <translation>Colorer le modèle selon sa distance à la référence</translation>
    </message>
    <message>
        <source>Distances are to a mesh: choose one as the reference.</source>
        <translation>Les distances se mesurent à un maillage : choisissez-en un comme référence.</translation>
    </message>
    <message>
        <source>%1 is %2 times as large as %3: are both in the same unit?</source>
        <translation>%1 est %2 fois plus grand que %3 : sont-ils dans la même unité ?</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::DeviationPanel</name>
    <message>
        <source>What deviates by less is grey: it is in tolerance</source>
        <translation>Ce qui s’écarte de moins est gris : c’est dans la tolérance</translation>
    </message>
    <message>
        <source>The deviation of the darkest colours; automatic: 95 of 100 vertices deviate less</source>
        <translation>L’écart des couleurs les plus foncées ; automatique : 95 sommets sur 100 s’écartent de moins</translation>
    </message>
    <message>
        <source>Deviations</source>
        <translation>Écarts</translation>
    </message>
    <message>
        <source>Colour the selected model by its signed distance to the reference: red outside of it, blue inside</source>
        <translation>Colorer le modèle sélectionné selon sa distance signée à la référence : rouge à l’extérieur, bleu à l’intérieur</translation>
    </message>
    <message>
        <source>Align to it</source>
        <translation>Aligner sur elle</translation>
    </message>
    <message>
        <source>Move the selected model rigidly onto the reference, from where it lies</source>
        <translation>Déplacer rigidement le modèle sélectionné sur la référence, à partir de sa position</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Masquer</translation>
    </message>
    <message>
        <source>Show the model in its own colours again</source>
        <translation>Afficher de nouveau le modèle dans ses propres couleurs</translation>
    </message>
    <message>
        <source>Export CSV…</source>
        <translation>Exporter en CSV…</translation>
    </message>
    <message>
        <source>The deviation of each vertex or point</source>
        <translation>L’écart de chaque sommet ou point</translation>
    </message>
    <message>
        <source>Reference of deviations</source>
        <translation>Référence des écarts</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>automatique</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Référence</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>Tolérance</translation>
    </message>
    <message>
        <source>Range of colours</source>
        <translation>Plage des couleurs</translation>
    </message>
    <message>
        <source>Deviation from %1</source>
        <translation>Écart par rapport à %1</translation>
    </message>
    <message>
        <source>Colour the deviations</source>
        <translation>Colorer les écarts</translation>
    </message>
    <message>
        <source>%1 to %2: mean %3, rms %4, from %5 to %6 mm. Within ±%7 mm %8 %, above %9 %, below %10 %. The reference is not drawn meanwhile.</source>
        <translation>%1 par rapport à %2 : moyenne %3, RMS %4, de %5 à %6 mm. À ±%7 mm près : %8 %, au-dessus : %9 %, au-dessous : %10 %. La référence n’est pas affichée entre-temps.</translation>
    </message>
    <message>
        <source>Align</source>
        <translation>Aligner</translation>
    </message>
    <message>
        <source>align %1</source>
        <translation>aligner %1</translation>
    </message>
    <message>
        <source>%1 to %2: </source>
        <translation>%1 sur %2 : </translation>
    </message>
    <message>
        <source>Export deviations</source>
        <translation>Exporter les écarts</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>Tableau (*.csv)</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>Exporter %1</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Écrit : %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::EditPanel</name>
    <message>
        <source>Rectangle</source>
        <translation>Rectangle</translation>
    </message>
    <message>
        <source>Select what a rectangle on the screen encloses</source>
        <translation>Sélectionner ce qu’un rectangle entoure à l’écran</translation>
    </message>
    <message>
        <source>Lasso</source>
        <translation>Lasso</translation>
    </message>
    <message>
        <source>Select what an outline on the screen encloses</source>
        <translation>Sélectionner ce qu’un contour entoure à l’écran</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinceau</translation>
    </message>
    <message>
        <source>Select what is painted over</source>
        <translation>Sélectionner ce que l’on peint</translation>
    </message>
    <message>
        <source>; with Shift it is added, with Ctrl subtracted, with Alt the mouse turns the camera</source>
        <translation> ; avec Maj, ajouter ; avec Ctrl, retirer ; avec Alt, la souris tourne la caméra</translation>
    </message>
    <message>
        <source>Select</source>
        <translation>Sélectionner</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Ajouter</translation>
    </message>
    <message>
        <source>Subtract</source>
        <translation>Retirer</translation>
    </message>
    <message>
        <source>What the tool does with what was selected before</source>
        <translation>Ce que l’outil fait de la sélection précédente</translation>
    </message>
    <message>
        <source>Through</source>
        <translation>À travers</translation>
    </message>
    <message>
        <source>Select what is hidden behind other parts, too</source>
        <translation>Sélectionner aussi ce qui est caché derrière d’autres parties</translation>
    </message>
    <message>
        <source>Radius of the brush on the screen</source>
        <translation>Rayon du pinceau à l’écran</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Tout</translation>
    </message>
    <message>
        <source>Select the whole model</source>
        <translation>Sélectionner tout le modèle</translation>
    </message>
    <message>
        <source>Invert</source>
        <translation>Inverser</translation>
    </message>
    <message>
        <source>Select what is not selected</source>
        <translation>Sélectionner ce qui n’est pas sélectionné</translation>
    </message>
    <message>
        <source>Nothing</source>
        <translation>Rien</translation>
    </message>
    <message>
        <source>Forget the selection</source>
        <translation>Oublier la sélection</translation>
    </message>
    <message>
        <source>Grow</source>
        <translation>Étendre</translation>
    </message>
    <message>
        <source>Add the neighbours of what is selected</source>
        <translation>Ajouter les voisins de la sélection</translation>
    </message>
    <message>
        <source>Shrink</source>
        <translation>Réduire</translation>
    </message>
    <message>
        <source>Leave out the rim of the selection</source>
        <translation>Retirer le bord de la sélection</translation>
    </message>
    <message>
        <source>Connected</source>
        <translation>Connecté</translation>
    </message>
    <message>
        <source>Add everything that is connected to the selection</source>
        <translation>Ajouter tout ce qui est relié à la sélection</translation>
    </message>
    <message>
        <source>Delete selected</source>
        <translation>Supprimer la sélection</translation>
    </message>
    <message>
        <source>Delete what is selected (Del)</source>
        <translation>Supprimer ce qui est sélectionné (Suppr)</translation>
    </message>
    <message>
        <source>Fill holes</source>
        <translation>Boucher les trous</translation>
    </message>
    <message>
        <source>Close the holes beside the selection; without one, all</source>
        <translation>Boucher les trous voisins de la sélection ; sans sélection, tous</translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation>Lisser</translation>
    </message>
    <message>
        <source>Smooth waves shorter than this in the selection; without one, in the whole mesh</source>
        <translation>Lisser dans la sélection les ondes plus courtes que cette longueur ; sans sélection, dans tout le maillage</translation>
    </message>
    <message>
        <source>Reduce to</source>
        <translation>Réduire à</translation>
    </message>
    <message>
        <source>Reduce to this number by merging triangles of the selection; without one, of the whole mesh</source>
        <translation>Réduire à ce nombre en fusionnant des triangles de la sélection ; sans sélection, de tout le maillage</translation>
    </message>
    <message>
        <source>Waves of this length lose half of their height</source>
        <translation>Les ondes de cette longueur perdent la moitié de leur hauteur</translation>
    </message>
    <message>
        <source>Triangles of the whole mesh afterwards</source>
        <translation>Triangles de tout le maillage après l’opération</translation>
    </message>
    <message>
        <source>Flat cut</source>
        <translation>Coupe plane</translation>
    </message>
    <message>
        <source>Take away one side of a plane; the cut of a closed mesh is closed</source>
        <translation>Enlever un côté d’un plan ; la coupe d’un maillage fermé est refermée</translation>
    </message>
    <message>
        <source>Cut off what is not shown</source>
        <translation>Couper ce qui n’est pas affiché</translation>
    </message>
    <message>
        <source>Choose a mesh or cloud above</source>
        <translation>Choisissez ci-dessus un maillage ou un nuage</translation>
    </message>
    <message>
        <source>Nothing selected</source>
        <translation>Rien de sélectionné</translation>
    </message>
    <message>
        <source>%1 of %2 triangles selected</source>
        <translation>%1 triangles sur %2 sélectionnés</translation>
    </message>
    <message>
        <source>%1 of %2 points selected</source>
        <translation>%1 points sur %2 sélectionnés</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 sur %2</translation>
    </message>
    <message>
        <source>%1 closed</source>
        <translation>%1 bouché(s)</translation>
    </message>
    <message>
        <source>waves below %1 mm</source>
        <translation>ondes de moins de %1 mm</translation>
    </message>
    <message>
        <source>Reduce</source>
        <translation>Réduire</translation>
    </message>
    <message>
        <source>%1 triangles, before %2</source>
        <translation>%1 triangles, %2 auparavant</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Couper</translation>
    </message>
    <message>
        <source>one side of the plane is left</source>
        <translation>il reste un côté du plan</translation>
    </message>
    <message>
        <source>closed by a face of %1 cm²</source>
        <translation>refermé par une face de %1 cm²</translation>
    </message>
    <message>
        <source>the cut is open, as the mesh was not closed</source>
        <translation>la coupe est ouverte, car le maillage n’était pas fermé</translation>
    </message>
    <message>
        <source>select</source>
        <translation>sélectionner</translation>
    </message>
    <message>
        <source>%1; its texture does not fit any more</source>
        <translation>%1 ; sa texture ne correspond plus</translation>
    </message>
    <message>
        <source>Small pieces</source>
        <translation>Petits morceaux</translation>
    </message>
    <message>
        <source>Select every separate piece below a twentieth of the largest one</source>
        <translation>Sélectionner chaque morceau isolé plus petit qu’un vingtième du plus grand</translation>
    </message>
    <message numerus="yes">
        <source>%n small piece(s) selected</source>
        <translation>
            <numerusform>%n petit morceau sélectionné</numerusform>
            <numerusform>%n petits morceaux sélectionnés</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>; %n small piece(s) left, see Small pieces</source>
        <translation>
            <numerusform> ; il reste %n petit morceau, voir Petits morceaux</numerusform>
            <numerusform> ; il reste %n petits morceaux, voir Petits morceaux</numerusform>
        </translation>
    </message>
    <message>
        <source>%1 is hidden: show it in the list first</source>
        <translation>%1 est masqué : affichez-le d’abord dans la liste</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ExplorerMode</name>
    <message>
        <source>Compare</source>
        <translation>Comparaison</translation>
    </message>
    <message>
        <source>Another side</source>
        <translation>Autre côté</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Verdict</translation>
    </message>
    <message>
        <source>Nothing loaded yet</source>
        <translation>Rien n’est encore chargé</translation>
    </message>
    <message>
        <source>Drop meshes, point clouds or recordings here, or begin with a scan.</source>
        <translation>Déposez ici des maillages, des nuages de points ou des enregistrements, ou commencez par une numérisation.</translation>
    </message>
    <message>
        <source>Open…</source>
        <translation>Ouvrir…</translation>
    </message>
    <message>
        <source>Scan an object</source>
        <translation>Numériser un objet</translation>
    </message>
    <message>
        <source>Simulate a scan</source>
        <translation>Simuler une numérisation</translation>
    </message>
    <message>
        <source>Open meshes, clouds or recordings</source>
        <translation>Ouvrir des maillages, des nuages ou des enregistrements</translation>
    </message>
    <message>
        <source>Meshes, clouds and recordings (*.ply *.pcd *.stl *.obj *.off *.3mf *.glb *.dae *.fbx recording.json *.bag *.mcap *.db3 *.mkv *.r3d *.sens *.conf *.json);;All files (*)</source>
        <translation>Maillages, nuages et enregistrements (*.ply *.pcd *.stl *.obj *.off *.3mf *.glb *.dae *.fbx recording.json *.bag *.mcap *.db3 *.mkv *.r3d *.sens *.conf *.json);;Tous les fichiers (*)</translation>
    </message>
    <message>
        <source>Save %1</source>
        <translation>Sauvegarder %1</translation>
    </message>
    <message>
        <source>PLY (*.ply);;STL, millimetres (*.stl);;3MF, millimetres (*.3mf);;OBJ (*.obj);;GLB (*.glb)</source>
        <translation>PLY (*.ply);;STL, millimètres (*.stl);;3MF, millimètres (*.3mf);;OBJ (*.obj);;GLB (*.glb)</translation>
    </message>
    <message>
        <source>PLY (*.ply)</source>
        <translation>PLY (*.ply)</translation>
    </message>
    <message>
        <source>Export the report of %1</source>
        <translation>Exporter le rapport de %1</translation>
    </message>
    <message>
        <source>Report page (*.html)</source>
        <translation>Page de rapport (*.html)</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>Ouvrir %1</translation>
    </message>
    <message>
        <source>open %1</source>
        <translation>ouvrir %1</translation>
    </message>
    <message>
        <source>reconstruct</source>
        <translation>reconstruire</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filtrer</translation>
    </message>
    <message>
        <source>%1 filtered</source>
        <translation>%1 filtré</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 par rapport à %2</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Écrit : %1</translation>
    </message>
    <message>
        <source>Colour the mesh</source>
        <translation>Colorer le maillage</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>Exporter %1</translation>
    </message>
    <message>
        <source>; without the 3D view, which this build lacks</source>
        <translation> ; sans la vue 3D, absente de cette version</translation>
    </message>
    <message>
        <source>Wrote %1%2</source>
        <translation>Écrit : %1%2</translation>
    </message>
    <message>
        <source>Restore the session</source>
        <translation>Restaurer la session</translation>
    </message>
    <message>
        <source>restore the session</source>
        <translation>restaurer la session</translation>
    </message>
    <message>
        <source>These could not be restored, and are kept in %1: %2</source>
        <translation>Ces modèles n’ont pas pu être restaurés et sont conservés dans %1 : %2</translation>
    </message>
    <message>
        <source>Save preset</source>
        <translation>Sauvegarder le préréglage</translation>
    </message>
    <message>
        <source>Select a mesh or a cloud to export</source>
        <translation>Sélectionnez un maillage ou un nuage à exporter</translation>
    </message>
    <message>
        <source>Pictures, NAME-0001.png and so on (*.png)</source>
        <translation>Images, NOM-0001.png et ainsi de suite (*.png)</translation>
    </message>
    <message>
        <source>Turntable movie</source>
        <translation>Film du modèle en rotation</translation>
    </message>
    <message>
        <source>Film (*.mp4)</source>
        <translation>Film (*.mp4)</translation>
    </message>
    <message>
        <source>Reconstruct %1</source>
        <translation>Reconstruire %1</translation>
    </message>
    <message>
        <source>reconstruct %1</source>
        <translation>reconstruire %1</translation>
    </message>
    <message>
        <source>Deviations</source>
        <translation>Écarts</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Mesure</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>Section</translation>
    </message>
    <message>
        <source>Editing</source>
        <translation>Édition</translation>
    </message>
    <message>
        <source>History</source>
        <translation>Historique</translation>
    </message>
    <message>
        <source>filter %1</source>
        <translation>filtrer %1</translation>
    </message>
    <message>
        <source>distances</source>
        <translation>distances</translation>
    </message>
    <message>
        <source>Join by points</source>
        <translation>Assembler par points</translation>
    </message>
    <message>
        <source>%1
Another side, Join by points shows how it lay.</source>
        <translation>%1
Autre côté, Assembler par points permet d’indiquer comment il était posé.</translation>
    </message>
    <message>
        <source>Voxels</source>
        <translation>Voxels</translation>
    </message>
    <message>
        <source>Stages</source>
        <translation>Étapes</translation>
    </message>
    <message>
        <source>Voxelise keeps voxels with %1 points or more from now on</source>
        <translation>Désormais, Voxéliser conserve les voxels d’au moins %1 points</translation>
    </message>
    <message>
        <source>%1 was not opened</source>
        <translation>%1 n’a pas été ouvert</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Images</translation>
    </message>
    <message>
        <source>Inspect</source>
        <translation>Inspecter</translation>
    </message>
    <message>
        <source>Edit</source>
        <translation>Éditer</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Afficher</translation>
    </message>
    <message>
        <source>Process</source>
        <translation>Traiter</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ExportDialog</name>
    <message>
        <source>Export %1</source>
        <translation>Exporter %1</translation>
    </message>
    <message>
        <source>PLY</source>
        <translation>PLY</translation>
    </message>
    <message>
        <source>STL, for printing</source>
        <translation>STL, pour l’impression</translation>
    </message>
    <message>
        <source>3MF, for printing, with colours</source>
        <translation>3MF, pour l’impression, avec couleurs</translation>
    </message>
    <message>
        <source>OBJ</source>
        <translation>OBJ</translation>
    </message>
    <message>
        <source>GLB, for the web</source>
        <translation>GLB, pour le Web</translation>
    </message>
    <message>
        <source>Millimetres</source>
        <translation>Millimètres</translation>
    </message>
    <message>
        <source>Centimetres</source>
        <translation>Centimètres</translation>
    </message>
    <message>
        <source>Inches</source>
        <translation>Pouces</translation>
    </message>
    <message>
        <source>Metres</source>
        <translation>Mètres</translation>
    </message>
    <message>
        <source>Usual for the format: Z in STL and 3MF, else Y</source>
        <translation>Usage du format : Z en STL et 3MF, sinon Y</translation>
    </message>
    <message>
        <source>Y, as in the view</source>
        <translation>Y, comme dans la vue</translation>
    </message>
    <message>
        <source>Z, as slicers and CAD have it</source>
        <translation>Z, comme dans les trancheurs et la CAO</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Texture</translation>
    </message>
    <message>
        <source>Colours of the vertices</source>
        <translation>Couleurs des sommets</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Aucune</translation>
    </message>
    <message>
        <source>all %1</source>
        <translation>tous (%1)</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>Format</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Unité</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Axe vertical</translation>
    </message>
    <message>
        <source>Triangles, at most</source>
        <translation>Triangles, au plus</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>Couleurs</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exporter…</translation>
    </message>
    <message>
        <source>The format says its unit: %1.</source>
        <translation>Le format indique son unité : %1.</translation>
    </message>
    <message>
        <source>GLB is always Y up.</source>
        <translation>En GLB, Y est toujours vers le haut.</translation>
    </message>
    <message>
        <source>With fewer triangles the texture becomes colours of the vertices.</source>
        <translation>Avec moins de triangles, la texture devient des couleurs de sommets.</translation>
    </message>
    <message>
        <source>This format keeps no texture.</source>
        <translation>Ce format ne conserve pas la texture.</translation>
    </message>
    <message>
        <source>STL keeps no colours.</source>
        <translation>STL ne conserve pas les couleurs.</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::FramePanel</name>
    <message>
        <source>Frame of the recording</source>
        <translation>Image de l’enregistrement</translation>
    </message>
    <message>
        <source>Arrow keys step from frame to frame; frames left out are marked</source>
        <translation>Les flèches passent d’une image à l’autre ; les images écartées sont marquées</translation>
    </message>
    <message>
        <source>Depth image</source>
        <translation>Image de profondeur</translation>
    </message>
    <message>
        <source>Colour image</source>
        <translation>Image couleur</translation>
    </message>
    <message>
        <source>Frame %1 of %2</source>
        <translation>Image %1 sur %2</translation>
    </message>
    <message>
        <source>sensor %1</source>
        <translation>capteur %1</translation>
    </message>
    <message>
        <source>pass %1</source>
        <translation>passe %1</translation>
    </message>
    <message>
        <source>lost while it was recorded</source>
        <translation>perdue pendant l’enregistrement</translation>
    </message>
    <message>
        <source>left out of the mesh, because its pose is not known</source>
        <translation>absente du maillage, car sa pose n’est pas connue</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Image</translation>
    </message>
    <message>
        <source>Yellow is %1 m from the sensor, violet %2 m</source>
        <translation>Le jaune est à %1 m du capteur, le violet à %2 m</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::HistoryPanel</name>
    <message>
        <source>History</source>
        <translation>Historique</translation>
    </message>
    <message>
        <source>A click goes back to that state, or forward again</source>
        <translation>Un clic revient à cet état, ou avance de nouveau</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Début</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::JobBar</name>
    <message>
        <source>Cancel</source>
        <translation>Annuler</translation>
    </message>
    <message>
        <source>Stop the running job (Esc)</source>
        <translation>Arrêter la tâche en cours (Échap)</translation>
    </message>
    <message>
        <source>Progress of the running job</source>
        <translation>Progression de la tâche en cours</translation>
    </message>
    <message>
        <source>%1 s so far</source>
        <translation>%1 s écoulées</translation>
    </message>
    <message>
        <source>%1 more</source>
        <translation>%1 en attente</translation>
    </message>
    <message>
        <source>Next:</source>
        <translation>Ensuite :</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::JoinPanel</name>
    <message>
        <source>Mesh so far</source>
        <translation>Maillage actuel</translation>
    </message>
    <message>
        <source>New pass</source>
        <translation>Nouvelle passe</translation>
    </message>
    <message>
        <source>Pick pairs</source>
        <translation>Pointer</translation>
    </message>
    <message>
        <source>Click at least three places, each on both meshes</source>
        <translation>Cliquez sur trois points au moins, chacun sur les deux maillages</translation>
    </message>
    <message>
        <source>Undo click</source>
        <translation>Annuler le clic</translation>
    </message>
    <message>
        <source>Take the last click back</source>
        <translation>Reprendre le dernier clic</translation>
    </message>
    <message>
        <source>Join</source>
        <translation>Assembler</translation>
    </message>
    <message>
        <source>Bring the new pass there, refine its place by the surfaces, and make one mesh of all passes; refused where the surfaces contradict it</source>
        <translation>Y amener la nouvelle passe, affiner sa position d’après les surfaces et faire un seul maillage de toutes les passes ; refusé si les surfaces le contredisent</translation>
    </message>
    <message>
        <source>Each pass by itself</source>
        <translation>Chaque passe séparément</translation>
    </message>
    <message>
        <source>Make a mesh of each pass of the selected joined one, to join them anew</source>
        <translation>Faire un maillage de chaque passe du maillage assemblé sélectionné, pour les assembler de nouveau</translation>
    </message>
    <message>
        <source>Where a pass was not joined, or wrongly, pairs of places on both meshes say how it lay.</source>
        <translation>Si une passe n’a pas été assemblée, ou l’a mal été, des paires de points sur les deux maillages indiquent comment elle était placée.</translation>
    </message>
    <message>
        <source>Choose meshes of different passes of one recording.</source>
        <translation>Choisissez des maillages de passes différentes d’un même enregistrement.</translation>
    </message>
    <message>
        <source>Pair %1: click the same place on both.</source>
        <translation>Paire %1 : cliquez sur le même point des deux.</translation>
    </message>
    <message>
        <source>Pair %1: click it on the right, too.</source>
        <translation>Paire %1 : cliquez aussi sur ce point à droite.</translation>
    </message>
    <message>
        <source>Pair %1: click it on the left, too.</source>
        <translation>Paire %1 : cliquez aussi sur ce point à gauche.</translation>
    </message>
    <message>
        <source>%1 pairs, which fit within %2 mm (rms). Join, or click more.</source>
        <translation>%1 paires, qui concordent à %2 mm près (RMS). Assemblez, ou pointez-en d’autres.</translation>
    </message>
    <message>
        <source>join by points</source>
        <translation>assembler par points</translation>
    </message>
    <message>
        <source>%1 and %2 are one mesh now</source>
        <translation>%1 et %2 forment maintenant un seul maillage</translation>
    </message>
    <message>
        <source>passes by themselves</source>
        <translation>passes séparément</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::LookPanel</name>
    <message>
        <source>Opacity of the selected model</source>
        <translation>Opacité du modèle sélectionné</translation>
    </message>
    <message>
        <source>Isolate</source>
        <translation>Isoler</translation>
    </message>
    <message>
        <source>Show the selected model alone</source>
        <translation>Afficher seulement le modèle sélectionné</translation>
    </message>
    <message>
        <source>Turntable movie…</source>
        <translation>Film…</translation>
    </message>
    <message>
        <source>A film or pictures of the view, turned once about the vertical</source>
        <translation>Un film ou des images de la vue, tournée une fois autour de la verticale</translation>
    </message>
    <message>
        <source>Ambient occlusion</source>
        <translation>Occlusion ambiante</translation>
    </message>
    <message>
        <source>Shaded</source>
        <translation>Ombré</translation>
    </message>
    <message>
        <source>Shaded, with edges</source>
        <translation>Ombré, avec arêtes</translation>
    </message>
    <message>
        <source>Wireframe</source>
        <translation>Filaire</translation>
    </message>
    <message>
        <source>Normals</source>
        <translation>Normales</translation>
    </message>
    <message>
        <source>How surfaces are drawn; normals: x red, y green, z blue</source>
        <translation>Mode d’affichage des surfaces ; normales : x rouge, y vert, z bleu</translation>
    </message>
    <message>
        <source>Draw recesses darker (ambient occlusion) while the view does not move; slow without a graphics card</source>
        <translation>Assombrir les creux (occlusion ambiante) tant que la vue ne bouge pas ; lent sans carte graphique</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>Surface</translation>
    </message>
    <message>
        <source>Opacity</source>
        <translation>Opacité</translation>
    </message>
    <message>
        <source>Clip</source>
        <translation>Coupe</translation>
    </message>
    <message>
        <source>Axis of the clipping plane</source>
        <translation>Axe du plan de coupe</translation>
    </message>
    <message>
        <source>Off</source>
        <translation>Aucun</translation>
    </message>
    <message>
        <source>Place of the clipping plane</source>
        <translation>Position du plan de coupe</translation>
    </message>
    <message>
        <source>Flip</source>
        <translation>Inverser</translation>
    </message>
    <message>
        <source>Show the other side</source>
        <translation>Afficher l’autre côté</translation>
    </message>
    <message>
        <source>Show the other side of the clipping plane</source>
        <translation>Afficher l’autre côté du plan de coupe</translation>
    </message>
    <message>
        <source>Stages…</source>
        <translation>Étapes…</translation>
    </message>
    <message>
        <source>What is checked in the list, side by side in one picture</source>
        <translation>Ce qui est coché dans la liste, côte à côte sur une image</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MainWindow</name>
    <message>
        <source>Left button</source>
        <translation>Bouton gauche</translation>
    </message>
    <message>
        <source>turn</source>
        <translation>tourner</translation>
    </message>
    <message>
        <source>Middle button, or Shift and left</source>
        <translation>Bouton du milieu, ou Maj et gauche</translation>
    </message>
    <message>
        <source>move</source>
        <translation>déplacer</translation>
    </message>
    <message>
        <source>Wheel, or right button</source>
        <translation>Molette, ou bouton droit</translation>
    </message>
    <message>
        <source>nearer, farther</source>
        <translation>rapprocher, éloigner</translation>
    </message>
    <message>
        <source>Arrows, +, -</source>
        <translation>Flèches, +, -</translation>
    </message>
    <message>
        <source>turn, nearer, farther</source>
        <translation>tourner, rapprocher, éloigner</translation>
    </message>
    <message>
        <source>Keyboard shortcuts</source>
        <translation>Raccourcis clavier</translation>
    </message>
    <message>
        <source>The manual is not installed here</source>
        <translation>Le manuel n’est pas installé ici</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Manuel</translation>
    </message>
    <message>
        <source>Messages, oldest first</source>
        <translation>Messages, du plus ancien au plus récent</translation>
    </message>
    <message>
        <source>Messages</source>
        <translation>Messages</translation>
    </message>
    <message>
        <source>From an object on a turntable to a watertight mesh.</source>
        <translation>D’un objet sur un plateau tournant à un maillage étanche.</translation>
    </message>
    <message>
        <source>turnscan is free software under the Apache License 2.0, whose text is below.</source>
        <translation>turnscan est un logiciel libre sous licence Apache 2.0, dont le texte figure ci-dessous.</translation>
    </message>
    <message>
        <source>It uses these libraries, with Qt %1 and VTK %2:</source>
        <translation>Il utilise ces bibliothèques, avec Qt %1 et VTK %2 :</translation>
    </message>
    <message>
        <source>About turnscan Studio</source>
        <translation>À propos de turnscan Studio</translation>
    </message>
    <message>
        <source>Open a recording</source>
        <translation>Ouvrir un enregistrement</translation>
    </message>
    <message>
        <source>Save screenshot</source>
        <translation>Sauvegarder une capture d’écran</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Images (*.png)</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Fichier</translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation>&amp;Ouvrir…</translation>
    </message>
    <message>
        <source>Open &amp;recording…</source>
        <translation>Ouvrir un &amp;enregistrement…</translation>
    </message>
    <message>
        <source>Open r&amp;ecent</source>
        <translation>Ouvrir un élément &amp;récent</translation>
    </message>
    <message>
        <source>&amp;Save…</source>
        <translation>&amp;Sauvegarder…</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation>E&amp;xporter…</translation>
    </message>
    <message>
        <source>Reconstruct se&amp;veral recordings…</source>
        <translation>Re&amp;construire plusieurs enregistrements…</translation>
    </message>
    <message>
        <source>Save s&amp;creenshot…</source>
        <translation>Sauvegarder une ca&amp;pture d’écran…</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Quitter</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>É&amp;dition</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Annuler</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Rétablir</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Supprimer</translation>
    </message>
    <message>
        <source>Cancel the running job</source>
        <translation>Annuler la tâche en cours</translation>
    </message>
    <message>
        <source>&amp;Language</source>
        <translation>&amp;Langue</translation>
    </message>
    <message>
        <source>The language changes with the next start</source>
        <translation>La langue changera au prochain démarrage</translation>
    </message>
    <message>
        <source>As the system</source>
        <translation>Celle du système</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Affichage</translation>
    </message>
    <message>
        <source>Reset camera</source>
        <translation>Tout cadrer</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Face</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Arrière</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Gauche</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Droite</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>Dessus</translation>
    </message>
    <message>
        <source>Bottom</source>
        <translation>Dessous</translation>
    </message>
    <message>
        <source>Corner</source>
        <translation>Coin</translation>
    </message>
    <message>
        <source>Bounding boxes</source>
        <translation>Boîtes englobantes</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Sombre</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>A&amp;ide</translation>
    </message>
    <message>
        <source>&amp;Manual</source>
        <translation>&amp;Manuel</translation>
    </message>
    <message>
        <source>&amp;Keyboard shortcuts</source>
        <translation>&amp;Raccourcis clavier</translation>
    </message>
    <message>
        <source>&amp;About turnscan Studio</source>
        <translation>À &amp;propos de turnscan Studio</translation>
    </message>
    <message>
        <source>turnscan Studio</source>
        <translation>turnscan Studio</translation>
    </message>
    <message>
        <source>3D Scanner</source>
        <translation>Scanner 3D</translation>
    </message>
    <message>
        <source>Calibrate and record with a sensor (F1)</source>
        <translation>Étalonner et enregistrer avec un capteur (F1)</translation>
    </message>
    <message>
        <source>Model Explorer</source>
        <translation>Explorateur de modèles</translation>
    </message>
    <message>
        <source>Look at models and process them (F2)</source>
        <translation>Examiner des modèles et les traiter (F2)</translation>
    </message>
    <message>
        <source>Scanner Simulator</source>
        <translation>Simulateur de scanners</translation>
    </message>
    <message>
        <source>Try a rig before it is built (F3)</source>
        <translation>Essayer un montage avant de le construire (F3)</translation>
    </message>
    <message>
        <source>%1: cancelled</source>
        <translation>%1 : annulé</translation>
    </message>
    <message>
        <source>%1: failed</source>
        <translation>%1 : échec</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Écrit : %1</translation>
    </message>
    <message>
        <source>No files yet</source>
        <translation>Aucun fichier pour l’instant</translation>
    </message>
    <message>
        <source>Undo %1</source>
        <translation>Annuler : %1</translation>
    </message>
    <message>
        <source>Redo %1</source>
        <translation>Rétablir : %1</translation>
    </message>
    <message>
        <source>A recording runs; it ends, and what it has is kept</source>
        <translation>Un enregistrement est en cours ; il prendra fin et ce qu’il contient sera conservé</translation>
    </message>
    <message>
        <source>Go on with the recording?</source>
        <translation>Continuer l’enregistrement ?</translation>
    </message>
    <message numerus="yes">
        <source>The last session ended while it recorded. %1 has %n frame(s).</source>
        <translation>
            <numerusform>La dernière session s’est terminée pendant l’enregistrement. %1 contient %n image.</numerusform>
            <numerusform>La dernière session s’est terminée pendant l’enregistrement. %1 contient %n images.</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Continuer</translation>
    </message>
    <message>
        <source>Leave it</source>
        <translation>Le laisser</translation>
    </message>
    <message>
        <source>Restore the last session?</source>
        <translation>Restaurer la dernière session ?</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Restaurer</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Abandonner</translation>
    </message>
    <message>
        <source>Ask again later</source>
        <translation>Redemander plus tard</translation>
    </message>
    <message>
        <source>All models are in files</source>
        <translation>Tous les modèles sont dans des fichiers</translation>
    </message>
    <message>
        <source>Folder for all models</source>
        <translation>Dossier pour tous les modèles</translation>
    </message>
    <message>
        <source>Save &amp;all…</source>
        <translation>&amp;Tout sauvegarder…</translation>
    </message>
    <message numerus="yes">
        <source>%n model(s) cannot be kept for the next start and are in no file: %1</source>
        <translation>
            <numerusform>%n modèle ne peut pas être conservé pour le prochain démarrage et n’est dans aucun fichier : %1</numerusform>
            <numerusform>%n modèles ne peuvent pas être conservés pour le prochain démarrage et ne sont dans aucun fichier : %1</numerusform>
        </translation>
    </message>
    <message>
        <source>The last session had these models:
%1</source>
        <translation>La dernière session contenait ces modèles :
%1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MeasurePanel</name>
    <message>
        <source>A plane is fitted to the surface within this distance of the click</source>
        <translation>Un plan est ajusté à la surface jusqu’à cette distance du clic</translation>
    </message>
    <message>
        <source>Radius of the patch that a plane is fitted to</source>
        <translation>Rayon de la zone à laquelle un plan est ajusté</translation>
    </message>
    <message>
        <source>Plane within</source>
        <translation>Rayon du plan</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Mesures</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Retirer</translation>
    </message>
    <message>
        <source>Remove the chosen measurement</source>
        <translation>Retirer la mesure choisie</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>Effacer</translation>
    </message>
    <message>
        <source>Remove all measurements</source>
        <translation>Retirer toutes les mesures</translation>
    </message>
    <message>
        <source>Export CSV…</source>
        <translation>Exporter en CSV…</translation>
    </message>
    <message>
        <source>All measurements as a table</source>
        <translation>Toutes les mesures dans un tableau</translation>
    </message>
    <message>
        <source>Place %1 of %2</source>
        <translation>Point %1 sur %2</translation>
    </message>
    <message>
        <source>Export measurements</source>
        <translation>Exporter les mesures</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>Tableau (*.csv)</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>Exporter %1</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Écrit : %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MessageLog</name>
    <message>
        <source>Error: </source>
        <translation>Erreur : </translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ModelList</name>
    <message>
        <source>Properties of the selected model</source>
        <translation>Propriétés du modèle sélectionné</translation>
    </message>
    <message>
        <source>Open…</source>
        <translation>Ouvrir…</translation>
    </message>
    <message>
        <source>Load meshes, clouds or recordings (Ctrl+O)</source>
        <translation>Charger des maillages, des nuages ou des enregistrements (Ctrl+O)</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Sauvegarder…</translation>
    </message>
    <message>
        <source>Save the selected model (Ctrl+S)</source>
        <translation>Sauvegarder le modèle sélectionné (Ctrl+S)</translation>
    </message>
    <message>
        <source>Edit</source>
        <translation>Modifier</translation>
    </message>
    <message>
        <source>Rename, colour, duplicate, delete</source>
        <translation>Renommer, colorer, dupliquer, supprimer</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Renommer</translation>
    </message>
    <message>
        <source>Colour…</source>
        <translation>Couleur…</translation>
    </message>
    <message>
        <source>Own colours on/off</source>
        <translation>Couleurs propres oui/non</translation>
    </message>
    <message>
        <source>Duplicate</source>
        <translation>Dupliquer</translation>
    </message>
    <message>
        <source>Delete	Del</source>
        <translation>Supprimer	Suppr</translation>
    </message>
    <message>
        <source>Colour of %1</source>
        <translation>Couleur de %1</translation>
    </message>
    <message>
        <source>Models</source>
        <translation>Modèles</translation>
    </message>
    <message>
        <source>Use its settings</source>
        <translation>Reprendre ses réglages</translation>
    </message>
    <message>
        <source>Not made with the defaults:
%1</source>
        <translation>Pas fait avec les valeurs par défaut :
%1</translation>
    </message>
    <message>
        <source>Pass %1</source>
        <translation>Passe %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ModelStore</name>
    <message>
        <source>add %1</source>
        <translation>ajouter %1</translation>
    </message>
    <message>
        <source>rename</source>
        <translation>renommer</translation>
    </message>
    <message>
        <source>show</source>
        <translation>afficher</translation>
    </message>
    <message>
        <source>hide</source>
        <translation>masquer</translation>
    </message>
    <message>
        <source>colour</source>
        <translation>couleur</translation>
    </message>
    <message>
        <source>opacity of %1</source>
        <translation>opacité de %1</translation>
    </message>
    <message>
        <source>duplicate</source>
        <translation>dupliquer</translation>
    </message>
    <message>
        <source>delete</source>
        <translation>supprimer</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MotorPanel</name>
    <message>
        <source>Serial port of the board that turns the table, e.g. /dev/ttyUSB0</source>
        <translation>Port série de la carte qui fait tourner le plateau, p. ex. /dev/ttyUSB0</translation>
    </message>
    <message>
        <source>Turn</source>
        <translation>Tourner</translation>
    </message>
    <message>
        <source>Turn the table to see that it works: 10 degrees a second</source>
        <translation>Faire tourner le plateau pour vérifier qu’il fonctionne : 10 degrés par seconde</translation>
    </message>
    <message>
        <source>With a motor, Record turns the table by itself.</source>
        <translation>Avec un moteur, Enregistrer fait tourner le plateau.</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>Carte</translation>
    </message>
    <message>
        <source>No motor</source>
        <translation>Sans moteur</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Arrêter</translation>
    </message>
    <message>
        <source>Turning</source>
        <translation>Rotation en cours</translation>
    </message>
    <message>
        <source>The table stands at %1 degrees</source>
        <translation>Le plateau est à %1 degrés</translation>
    </message>
    <message>
        <source>The table does not turn</source>
        <translation>Le plateau ne tourne pas</translation>
    </message>
    <message>
        <source>Port of the motor</source>
        <translation>Port du moteur</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::OptionForm</name>
    <message>
        <source>automatic</source>
        <translation>automatique</translation>
    </message>
    <message>
        <source>auto: %1</source>
        <translation>auto : %1</translation>
    </message>
    <message>
        <source>&lt;br&gt;&lt;i&gt;Last run: %1, %2&lt;/i&gt;</source>
        <translation>&lt;br&gt;&lt;i&gt;Dernière exécution : %1, %2&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;br&gt;&lt;i&gt;Not the default, %1: click to reset&lt;/i&gt;</source>
        <translation>&lt;br&gt;&lt;i&gt;Différent de la valeur par défaut, %1 : cliquez pour rétablir&lt;/i&gt;</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::PlaneBox</name>
    <message>
        <source>Flip</source>
        <translation>Inverser</translation>
    </message>
    <message>
        <source>Keep the other side</source>
        <translation>Garder l’autre côté</translation>
    </message>
    <message>
        <source>The axis that the plane is perpendicular to</source>
        <translation>L’axe auquel le plan est perpendiculaire</translation>
    </message>
    <message>
        <source>Axis of the plane</source>
        <translation>Axe du plan</translation>
    </message>
    <message>
        <source>Where the plane meets the axis</source>
        <translation>Où le plan coupe l’axe</translation>
    </message>
    <message>
        <source>Place of the plane</source>
        <translation>Position du plan</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::QueueDialog</name>
    <message>
        <source>Reconstruct several recordings</source>
        <translation>Reconstruire plusieurs enregistrements</translation>
    </message>
    <message>
        <source>They are reconstructed one after the other with the options of the Model Explorer. Add recordings, or drop them here.</source>
        <translation>Ils sont reconstruits l’un après l’autre avec les options de l’Explorateur de modèles. Ajoutez des enregistrements ou déposez-les ici.</translation>
    </message>
    <message>
        <source>Recordings in the queue</source>
        <translation>Enregistrements dans la file</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Enregistrement</translation>
    </message>
    <message>
        <source>State</source>
        <translation>État</translation>
    </message>
    <message>
        <source>Write meshes to</source>
        <translation>Écrire les maillages dans</translation>
    </message>
    <message>
        <source>nowhere: they are in the Model Explorer only</source>
        <translation>nulle part : seulement dans l’Explorateur de modèles</translation>
    </message>
    <message>
        <source>running</source>
        <translation>en cours</translation>
    </message>
    <message>
        <source>cancelled</source>
        <translation>annulé</translation>
    </message>
    <message>
        <source>Add recording…</source>
        <translation>Ajouter un enregistrement…</translation>
    </message>
    <message>
        <source>The folder of a recording</source>
        <translation>Le dossier d’un enregistrement</translation>
    </message>
    <message>
        <source>Add files…</source>
        <translation>Ajouter des fichiers…</translation>
    </message>
    <message>
        <source>Recordings of other programs</source>
        <translation>Enregistrements d’autres programmes</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Retirer</translation>
    </message>
    <message>
        <source>Take the selected ones off the list</source>
        <translation>Retirer de la liste les éléments sélectionnés</translation>
    </message>
    <message>
        <source>Reconstruct all</source>
        <translation>Tout reconstruire</translation>
    </message>
    <message>
        <source>Begin with the first that waits</source>
        <translation>Commencer par le premier en attente</translation>
    </message>
    <message>
        <source>Add a recording</source>
        <translation>Ajouter un enregistrement</translation>
    </message>
    <message>
        <source>Add recordings</source>
        <translation>Ajouter des enregistrements</translation>
    </message>
    <message>
        <source>waits</source>
        <translation>en attente</translation>
    </message>
    <message>
        <source>queued</source>
        <translation>en file</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::RecordPanel</name>
    <message>
        <source>Folder to make; a number is added where it has content</source>
        <translation>Dossier à créer ; un numéro est ajouté s’il n’est pas vide</translation>
    </message>
    <message>
        <source>…</source>
        <translation>…</translation>
    </message>
    <message>
        <source>Choose the folder</source>
        <translation>Choisir le dossier</translation>
    </message>
    <message>
        <source>Make the mesh when it is done</source>
        <translation>Faire le maillage à la fin</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Enregistrer</translation>
    </message>
    <message>
        <source>Folder of the recording</source>
        <translation>Dossier de l’enregistrement</translation>
    </message>
    <message>
        <source>The recording in %1 was ended early. It goes on with the same device and the same options.</source>
        <translation>L’enregistrement dans %1 a été interrompu. Il continue avec le même appareil et les mêmes options.</translation>
    </message>
    <message>
        <source>Go on with the recording</source>
        <translation>Continuer l’enregistrement</translation>
    </message>
    <message>
        <source>New recording instead</source>
        <translation>Plutôt un nouvel enregistrement</translation>
    </message>
    <message>
        <source>What is recorded next is another object, or this one anew</source>
        <translation>Ce qui sera enregistré ensuite est un autre objet, ou de nouveau celui-ci</translation>
    </message>
    <message>
        <source>The next pass goes into %1. %2</source>
        <translation>La prochaine passe va dans %1. %2</translation>
    </message>
    <message>
        <source>Motor</source>
        <translation>Moteur</translation>
    </message>
    <message>
        <source>More options</source>
        <translation>Plus d’options</translation>
    </message>
    <message>
        <source>The motor is being tried; stop it first</source>
        <translation>Le moteur est à l’essai ; arrêtez-le d’abord</translation>
    </message>
    <message>
        <source>turn %1</source>
        <translation>tour %1</translation>
    </message>
    <message>
        <source>turns not known yet</source>
        <translation>tours encore inconnus</translation>
    </message>
    <message>
        <source>, %1 GB free</source>
        <translation>, %1 Go libres</translation>
    </message>
    <message>
        <source>%1 frames, %2, %3 dropped%4</source>
        <translation>%1 images, %2, %3 perdues%4</translation>
    </message>
    <message>
        <source>Seen so far: about %1 cm², %2 % of it well (from %3 sides or more)</source>
        <translation>Vu jusqu’ici : environ %1 cm², dont %2 % bien (depuis %3 côtés ou plus)</translation>
    </message>
    <message>
        <source>; %1 % of the surface is still missing</source>
        <translation> ; il manque encore %1 % de la surface</translation>
    </message>
    <message>
        <source>Stop recording</source>
        <translation>Arrêter l’enregistrement</translation>
    </message>
    <message>
        <source>Record another side</source>
        <translation>Enregistrer un autre côté</translation>
    </message>
    <message>
        <source>The surface is shown once the object&apos;s motion is known, seconds after it begins to turn.</source>
        <translation>La surface s’affiche dès que le mouvement de l’objet est connu, quelques secondes après le début de sa rotation.</translation>
    </message>
    <message>
        <source>Recorded %1</source>
        <translation>Enregistré : %1</translation>
    </message>
    <message>
        <source>Progress of the recording</source>
        <translation>Progression de l’enregistrement</translation>
    </message>
    <message>
        <source>Record until the turns are done; Space records and stops</source>
        <translation>Enregistrer jusqu’à la fin des tours ; Espace enregistre et arrête</translation>
    </message>
    <message>
        <source>It has content: the next recording goes into %1</source>
        <translation>Il n’est pas vide : le prochain enregistrement va dans %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ScannerEditor</name>
    <message>
        <source>What it is</source>
        <translation>Ce que c’est</translation>
    </message>
    <message>
        <source>Where it stands</source>
        <translation>Où il se trouve</translation>
    </message>
    <message>
        <source>Its noise</source>
        <translation>Son bruit</translation>
    </message>
    <message>
        <source>Preset to fill the fields from</source>
        <translation>Préréglage avec lequel remplir les champs</translation>
    </message>
    <message>
        <source>Fill from…</source>
        <translation>Remplir avec…</translation>
    </message>
    <message>
        <source>Save as scanner…</source>
        <translation>Sauvegarder…</translation>
    </message>
    <message>
        <source>These fields as a file for --scanner and for Add scanner</source>
        <translation>Ces champs dans un fichier pour --scanner et pour Ajouter un scanner</translation>
    </message>
    <message>
        <source>%1, changed</source>
        <translation>%1, modifié</translation>
    </message>
    <message>
        <source>Save as scanner</source>
        <translation>Sauvegarder le scanner</translation>
    </message>
    <message>
        <source>Scanners (*.toml)</source>
        <translation>Scanners (*.toml)</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ScannerMode</name>
    <message>
        <source>No picture yet</source>
        <translation>Pas encore d’image</translation>
    </message>
    <message>
        <source>Choose a device on the right and press Play. The virtual sensors need no hardware.</source>
        <translation>Choisissez un appareil à droite et cliquez sur Afficher. Les capteurs virtuels n’exigent aucun matériel.</translation>
    </message>
    <message>
        <source>Play now</source>
        <translation>Afficher maintenant</translation>
    </message>
    <message>
        <source>1  Device</source>
        <translation>1  Appareil</translation>
    </message>
    <message>
        <source>A device of the list, or any URI, e.g. replay:FOLDER</source>
        <translation>Un appareil de la liste, ou une URI quelconque, p. ex. replay:DOSSIER</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Afficher</translation>
    </message>
    <message>
        <source>Show what the sensor sees</source>
        <translation>Afficher ce que voit le capteur</translation>
    </message>
    <message>
        <source>Filter points</source>
        <translation>Filtrer les points</translation>
    </message>
    <message>
        <source>Show only what stands on the turntable; needs a calibration</source>
        <translation>Afficher seulement ce qui est sur le plateau tournant ; exige un étalonnage</translation>
    </message>
    <message>
        <source>Back to live</source>
        <translation>Direct</translation>
    </message>
    <message>
        <source>Show what the sensor sees now</source>
        <translation>Afficher ce que le capteur voit maintenant</translation>
    </message>
    <message>
        <source>Not playing</source>
        <translation>À l’arrêt</translation>
    </message>
    <message>
        <source>3  Recording</source>
        <translation>3  Enregistrement</translation>
    </message>
    <message>
        <source>Calibrate again</source>
        <translation>Réétalonner</translation>
    </message>
    <message>
        <source>Take an averaged scan of the empty table, then press Calibrate</source>
        <translation>Faites une numérisation moyennée du plateau vide, puis cliquez sur Étalonner</translation>
    </message>
    <message>
        <source>Use motion</source>
        <translation>Utiliser le mouvement</translation>
    </message>
    <message>
        <source>Forget the calibration: the object&apos;s motion shows where the table is</source>
        <translation>Oublier l’étalonnage : le mouvement de l’objet montre où est le plateau</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, doll</source>
        <translation>Kinect v2 virtuelle, poupée</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, letter A on a desk</source>
        <translation>Kinect v2 virtuelle, lettre A sur un bureau</translation>
    </message>
    <message>
        <source>Virtual Kinect v1, cylinder</source>
        <translation>Kinect v1 virtuelle, cylindre</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, empty table on a desk</source>
        <translation>Kinect v2 virtuelle, plateau vide sur un bureau</translation>
    </message>
    <message>
        <source>Look for devices</source>
        <translation>Chercher des appareils</translation>
    </message>
    <message>
        <source>Stopping</source>
        <translation>Arrêt en cours</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Arrêter</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>Ouverture de %1</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Écrit : %1</translation>
    </message>
    <message>
        <source>Averaging: %1 of %2 frames</source>
        <translation>Moyenne : %1 images sur %2</translation>
    </message>
    <message>
        <source>click</source>
        <translation>clic</translation>
    </message>
    <message>
        <source>2  Calibration</source>
        <translation>2  Étalonnage</translation>
    </message>
    <message>
        <source>Averaged scan</source>
        <translation>Moyenner</translation>
    </message>
    <message>
        <source>Average frames of what stands still</source>
        <translation>Faire la moyenne d’images de ce qui est immobile</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Étalonner</translation>
    </message>
    <message>
        <source>Options</source>
        <translation>Options</translation>
    </message>
    <message>
        <source>Pick rim points</source>
        <translation>Pointer le bord</translation>
    </message>
    <message>
        <source>Click at least 3 points on the platter&apos;s rim</source>
        <translation>Cliquez sur au moins 3 points du bord du plateau</translation>
    </message>
    <message>
        <source>Undo click</source>
        <translation>Annuler le clic</translation>
    </message>
    <message>
        <source>Take back the last point (Ctrl+Z)</source>
        <translation>Reprendre le dernier point (Ctrl+Z)</translation>
    </message>
    <message>
        <source>Load…</source>
        <translation>Charger…</translation>
    </message>
    <message>
        <source>A calibration saved before</source>
        <translation>Un étalonnage sauvegardé auparavant</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Sauvegarder…</translation>
    </message>
    <message>
        <source>Keep the calibration as a file</source>
        <translation>Conserver l’étalonnage dans un fichier</translation>
    </message>
    <message>
        <source>Calibrations (*.json)</source>
        <translation>Étalonnages (*.json)</translation>
    </message>
    <message>
        <source>Load calibration</source>
        <translation>Charger un étalonnage</translation>
    </message>
    <message>
        <source>Save calibration</source>
        <translation>Sauvegarder l’étalonnage</translation>
    </message>
    <message>
        <source>Averaged %1 frames; noise of one frame %2</source>
        <translation>Moyenne de %1 images ; bruit d’une image %2</translation>
    </message>
    <message>
        <source>%1. Pick points on the platter&apos;s rim instead.</source>
        <translation>%1. Pointez plutôt le bord du plateau.</translation>
    </message>
    <message>
        <source>Click points on the rim of the platter, at least 3</source>
        <translation>Cliquez sur des points du bord du plateau, au moins 3</translation>
    </message>
    <message>
        <source>%1 of at least 3 points</source>
        <translation>%1 points sur au moins 3</translation>
    </message>
    <message>
        <source>By %1: radius %2, error %3 (root mean square)</source>
        <translation>Par %1 : rayon %2, erreur %3 (moyenne quadratique)</translation>
    </message>
    <message>
        <source>
From the last recording with this device. Calibrate anew if sensor or table were moved since.</source>
        <translation>
Tiré du dernier enregistrement avec cet appareil. Refaites l’étalonnage si le capteur ou le plateau a été déplacé depuis.</translation>
    </message>
    <message>
        <source>The calibration of the last recording is not used: %1</source>
        <translation>L’étalonnage du dernier enregistrement n’est pas utilisé : %1</translation>
    </message>
    <message>
        <source>There is no calibration yet</source>
        <translation>Il n’y a pas encore d’étalonnage</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>Appareil</translation>
    </message>
    <message>
        <source>Waiting for the first picture</source>
        <translation>En attente de la première image</translation>
    </message>
    <message>
        <source>The device says itself where its table stands.</source>
        <translation>L’appareil indique lui-même où se trouve son plateau.</translation>
    </message>
    <message>
        <source>%1 frames a second, %2 points</source>
        <translation>%1 images par seconde, %2 points</translation>
    </message>
    <message>
        <source>Find the turntable in an averaged scan, which is taken if there is none</source>
        <translation>Chercher le plateau tournant dans une numérisation moyennée, faite s’il n’y en a pas</translation>
    </message>
    <message>
        <source>Correct</source>
        <translation>Correction</translation>
    </message>
    <message>
        <source>The points are %1 off a circle (root mean square); %2 is the limit. Undo those that are not on the rim</source>
        <translation>Les points s’écartent de %1 d’un cercle (moyenne quadratique) ; la limite est de %2. Annulez ceux qui ne sont pas sur le bord</translation>
    </message>
    <message>
        <source>Platter: radius %1, known to %2</source>
        <translation>Plateau : rayon %1, connu à %2 près</translation>
    </message>
    <message>
        <source>Platter: radius %1, how well is not known</source>
        <translation>Plateau : rayon %1, de précision inconnue</translation>
    </message>
    <message>
        <source>The platter is not where the calibration has it</source>
        <translation>Le plateau n’est pas là où l’étalonnage le situe</translation>
    </message>
    <message>
        <source>No platter is seen; the object&apos;s motion will show where the table is</source>
        <translation>Aucun plateau n’est visible ; le mouvement de l’objet montrera où il se trouve</translation>
    </message>
    <message>
        <source>not known: 3 points fit any circle</source>
        <translation>inconnue : 3 points sont toujours sur un cercle</translation>
    </message>
    <message>
        <source>The detected platter differs by %1 in its centre, %2 in its radius</source>
        <translation>Le plateau détecté diffère de %1 pour le centre, de %2 pour le rayon</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SectionPanel</name>
    <message>
        <source>Section</source>
        <translation>Section</translation>
    </message>
    <message>
        <source>Cut all models open by a plane, and close the selected one</source>
        <translation>Couper tous les modèles par un plan et refermer celui qui est sélectionné</translation>
    </message>
    <message>
        <source>Export DXF…</source>
        <translation>Exporter en DXF…</translation>
    </message>
    <message>
        <source>The contours as a drawing in millimetres</source>
        <translation>Les contours en dessin, en millimètres</translation>
    </message>
    <message>
        <source>Export SVG…</source>
        <translation>Exporter en SVG…</translation>
    </message>
    <message>
        <source>Drawing (*.dxf)</source>
        <translation>Dessin (*.dxf)</translation>
    </message>
    <message>
        <source>Drawing (*.svg)</source>
        <translation>Dessin (*.svg)</translation>
    </message>
    <message>
        <source>, %1 of them open: the mesh has holes there</source>
        <translation>, dont %1 ouverts : le maillage y a des trous</translation>
    </message>
    <message>
        <source>The plane does not meet the selected model</source>
        <translation>Le plan ne rencontre pas le modèle sélectionné</translation>
    </message>
    <message>
        <source>%1 contours%2, area %3 cm², length %4 mm</source>
        <translation>%1 contours%2, aire %3 cm², longueur %4 mm</translation>
    </message>
    <message>
        <source>Export the section</source>
        <translation>Exporter la section</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>Exporter %1</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Écrit : %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SessionKeeper</name>
    <message>
        <source>The session is not saved: %1 cannot be made</source>
        <translation>La session n’est pas conservée : impossible de créer %1</translation>
    </message>
    <message>
        <source>The session is not saved: %1</source>
        <translation>La session n’est pas conservée : %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SheetDialog</name>
    <message>
        <source>Stages</source>
        <translation>Étapes</translation>
    </message>
    <message>
        <source>Save the stages</source>
        <translation>Sauvegarder les étapes</translation>
    </message>
    <message>
        <source>PNG (*.png)</source>
        <translation>PNG (*.png)</translation>
    </message>
    <message>
        <source>%1 cannot be written; check the folder and its permissions</source>
        <translation>Impossible d’écrire %1 ; vérifiez le dossier et ses autorisations</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SidePanel</name>
    <message>
        <source>Show what no view saw</source>
        <translation>Montrer ce qu’aucune vue n’a vu</translation>
    </message>
    <message>
        <source>Surface that was closed without a measurement, in magenta</source>
        <translation>Surface refermée sans mesure, en magenta</translation>
    </message>
    <message>
        <source>Scan another side</source>
        <translation>Numériser un autre côté</translation>
    </message>
    <message>
        <source>Lay the object another way and record it again; the passes become one mesh</source>
        <translation>Posez l’objet autrement et enregistrez-le de nouveau ; les passes forment un seul maillage</translation>
    </message>
    <message>
        <source>Select a mesh that was made from a recording: what no view saw of it, and how to lay it for the next pass, stands here.</source>
        <translation>Sélectionnez un maillage tiré d’un enregistrement : ce qu’aucune vue n’en a vu, et comment poser l’objet pour la prochaine passe, s’affiche ici.</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SimulatorMode</name>
    <message>
        <source>Loading the object</source>
        <translation>Chargement de l’objet</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objet</translation>
    </message>
    <message>
        <source>File…</source>
        <translation>Fichier…</translation>
    </message>
    <message>
        <source>Any mesh: PLY, STL, OBJ, OFF, 3MF, GLB, …</source>
        <translation>Un maillage quelconque : PLY, STL, OBJ, OFF, 3MF, GLB, …</translation>
    </message>
    <message>
        <source>How it stands</source>
        <translation>Comment il est posé</translation>
    </message>
    <message>
        <source>Object to scan</source>
        <translation>Objet à numériser</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>Scène</translation>
    </message>
    <message>
        <source>Load scene…</source>
        <translation>Charger…</translation>
    </message>
    <message>
        <source>A scene file, as turnscan simulate reads it</source>
        <translation>Un fichier de scène, tel que turnscan simulate le lit</translation>
    </message>
    <message>
        <source>Save scene…</source>
        <translation>Sauvegarder…</translation>
    </message>
    <message>
        <source>Everything here as a file for --scene</source>
        <translation>Tout ceci dans un fichier pour --scene</translation>
    </message>
    <message>
        <source>Scenes (*.toml)</source>
        <translation>Scènes (*.toml)</translation>
    </message>
    <message>
        <source>Load scene</source>
        <translation>Charger une scène</translation>
    </message>
    <message>
        <source>Save scene</source>
        <translation>Sauvegarder la scène</translation>
    </message>
    <message>
        <source>Coverage</source>
        <translation>Couverture</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Enregistrement</translation>
    </message>
    <message>
        <source>Folder to create for the recording; if it exists, it must be empty</source>
        <translation>Dossier à créer pour l’enregistrement ; s’il existe, il doit être vide</translation>
    </message>
    <message>
        <source>…</source>
        <translation>…</translation>
    </message>
    <message>
        <source>Choose the folder</source>
        <translation>Choisir le dossier</translation>
    </message>
    <message>
        <source>Scan</source>
        <translation>Numériser</translation>
    </message>
    <message>
        <source>Record the object with all scanners</source>
        <translation>Enregistrer l’objet avec tous les scanners</translation>
    </message>
    <message>
        <source>Open in Explorer</source>
        <translation>Vers l’Explorateur</translation>
    </message>
    <message>
        <source>Load the recording in the Model Explorer</source>
        <translation>Charger l’enregistrement dans l’Explorateur de modèles</translation>
    </message>
    <message>
        <source>Reconstruct</source>
        <translation>Reconstruire</translation>
    </message>
    <message>
        <source>Load it there and run every stage</source>
        <translation>L’y charger et exécuter toutes les étapes</translation>
    </message>
    <message>
        <source>Folder of the recording</source>
        <translation>Dossier de l’enregistrement</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>Aperçu</translation>
    </message>
    <message>
        <source>There is no scanner; add one first</source>
        <translation>Il n’y a aucun scanner ; ajoutez-en un d’abord</translation>
    </message>
    <message>
        <source>What was covered</source>
        <translation>Ce qui a été couvert</translation>
    </message>
    <message>
        <source>Density of samples</source>
        <translation>Densité d’échantillons</translation>
    </message>
    <message>
        <source>Why it was missed</source>
        <translation>Cause des manques</translation>
    </message>
    <message>
        <source>The samples only</source>
        <translation>Seulement les échantillons</translation>
    </message>
    <message>
        <source>Hole</source>
        <translation>Trou</translation>
    </message>
    <message>
        <source>Size, mm</source>
        <translation>Taille, mm</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Raison</translation>
    </message>
    <message>
        <source>The largest holes; click one to fly there.</source>
        <translation>Les plus grands trous ; cliquez sur l’un d’eux pour y aller.</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Écrit : %1</translation>
    </message>
    <message>
        <source>%1 cm²</source>
        <translation>%1 cm²</translation>
    </message>
    <message>
        <source>Scanners</source>
        <translation>Scanners</translation>
    </message>
    <message>
        <source>Add scanner</source>
        <translation>Ajouter un scanner</translation>
    </message>
    <message>
        <source>Matrix and line scanners from presets</source>
        <translation>Scanners matriciels et à ligne prédéfinis</translation>
    </message>
    <message>
        <source>From file…</source>
        <translation>D’un fichier…</translation>
    </message>
    <message>
        <source>Scanner</source>
        <translation>Scanner</translation>
    </message>
    <message>
        <source>Scanners (*.toml)</source>
        <translation>Scanners (*.toml)</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Retirer</translation>
    </message>
    <message>
        <source>Remove the selected scanner</source>
        <translation>Retirer le scanner sélectionné</translation>
    </message>
    <message>
        <source>Drag a scanner in the view to move it, with Shift nearer or farther, or type its place:</source>
        <translation>Faites glisser un scanner dans la vue pour le déplacer, avec Maj pour le rapprocher ou l’éloigner, ou saisissez sa position :</translation>
    </message>
    <message>
        <source>change of the rig</source>
        <translation>modification du montage</translation>
    </message>
    <message>
        <source>What the colours show</source>
        <translation>Ce que montrent les couleurs</translation>
    </message>
    <message>
        <source>The largest holes</source>
        <translation>Les plus grands trous</translation>
    </message>
    <message>
        <source>Sweep</source>
        <translation>Balayage</translation>
    </message>
    <message>
        <source>Coverage of the selected scanner as it is turned:</source>
        <translation>Couverture du scanner sélectionné selon sa rotation :</translation>
    </message>
    <message>
        <source>The scanner that was swept is no longer there</source>
        <translation>Le scanner du balayage n’est plus là</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::StagePanel</name>
    <message>
        <source>Reconstruct</source>
        <translation>Reconstruire</translation>
    </message>
    <message>
        <source>Run every stage on the selected recording or cloud (Ctrl+R)</source>
        <translation>Exécuter toutes les étapes sur l’enregistrement ou le nuage sélectionné (Ctrl+R)</translation>
    </message>
    <message>
        <source>Load preset…</source>
        <translation>Charger…</translation>
    </message>
    <message>
        <source>Options from a TOML file</source>
        <translation>Options d’un fichier TOML</translation>
    </message>
    <message>
        <source>Save preset…</source>
        <translation>Sauvegarder…</translation>
    </message>
    <message>
        <source>Options as a TOML file for --config</source>
        <translation>Options dans un fichier TOML pour --config</translation>
    </message>
    <message>
        <source>Defaults</source>
        <translation>Par défaut</translation>
    </message>
    <message>
        <source>Set all options back</source>
        <translation>Rétablir toutes les options</translation>
    </message>
    <message>
        <source>Presets (*.toml)</source>
        <translation>Préréglages (*.toml)</translation>
    </message>
    <message>
        <source>Load preset</source>
        <translation>Charger un préréglage</translation>
    </message>
    <message>
        <source>Save preset</source>
        <translation>Sauvegarder le préréglage</translation>
    </message>
    <message>
        <source>Filter the cloud</source>
        <translation>Filtrer le nuage</translation>
    </message>
    <message>
        <source>Drop outliers of the selected cloud; adds a new model</source>
        <translation>Écarter les points aberrants du nuage sélectionné ; ajoute un nouveau modèle</translation>
    </message>
    <message>
        <source>Run the stages up to this one; adds its cloud as a new model</source>
        <translation>Exécuter les étapes jusqu’à celle-ci ; ajoute son nuage comme nouveau modèle</translation>
    </message>
    <message>
        <source>Not at the defaults: %1. &lt;a href=&quot;reset&quot;&gt;Reset&lt;/a&gt;</source>
        <translation>Différent des valeurs par défaut : %1. &lt;a href=&quot;reset&quot;&gt;Rétablir&lt;/a&gt;</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SweepPanel</name>
    <message>
        <source>Sweep</source>
        <translation>Balayer</translation>
    </message>
    <message>
        <source>Find the coverage with each of the values</source>
        <translation>Calculer la couverture avec chacune des valeurs</translation>
    </message>
    <message>
        <source>Use the best</source>
        <translation>Prendre la meilleure</translation>
    </message>
    <message>
        <source>Place the scanner where it covers most</source>
        <translation>Placer le scanner là où il couvre le plus</translation>
    </message>
    <message>
        <source>Option to sweep</source>
        <translation>Option à balayer</translation>
    </message>
    <message>
        <source>Values: from..to/step</source>
        <translation>Valeurs : de..à/pas</translation>
    </message>
    <message>
        <source>%1 at %2 covers most: %3 % of the surface</source>
        <translation>%1 à %2 couvre le plus : %3 % de la surface</translation>
    </message>
    <message>
        <source>From, to and step in degrees, e.g. -45..45/15</source>
        <translation>De, à et pas en degrés, p. ex. -45..45/15</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not from..to/step in degrees, e.g. -45..45/15</source>
        <translation>« %1 » n’est pas de la forme de..à/pas en degrés, p. ex. -45..45/15</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::TurntableMovie</name>
    <message>
        <source>The view was closed</source>
        <translation>La vue a été fermée</translation>
    </message>
    <message>
        <source>%1 cannot be written</source>
        <translation>Impossible d’écrire %1</translation>
    </message>
    <message>
        <source>Picture %1 of %2</source>
        <translation>Image %1 sur %2</translation>
    </message>
    <message>
        <source>Make the film</source>
        <translation>Faire le film</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::VerdictPanel</name>
    <message>
        <source>Verdict</source>
        <translation>Verdict</translation>
    </message>
    <message>
        <source>Colours of the mesh</source>
        <translation>Couleurs du maillage</translation>
    </message>
    <message>
        <source>What the colours of the selected mesh show</source>
        <translation>Ce que montrent les couleurs du maillage sélectionné</translation>
    </message>
    <message>
        <source>Export report…</source>
        <translation>Rapport…</translation>
    </message>
    <message>
        <source>One HTML file with the model in 3D, the verdict, pictures and plots</source>
        <translation>Un fichier HTML avec le modèle en 3D, le verdict, des images et des graphiques</translation>
    </message>
    <message>
        <source>Own colours</source>
        <translation>Couleurs propres</translation>
    </message>
    <message>
        <source>Select a mesh that was made from a recording: how good it is, and why, stands here. One that was edited, opened from a file or restored has no verdict; reconstruct its recording for one.</source>
        <translation>Sélectionnez un maillage tiré d’un enregistrement : sa qualité, et pourquoi, s’affiche ici. Un maillage modifié, ouvert depuis un fichier ou restauré n’a pas de verdict ; reconstruisez son enregistrement pour en obtenir un.</translation>
    </message>
    <message>
        <source>Other findings</source>
        <translation>Autres constats</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ViewPanel</name>
    <message>
        <source>Bounding boxes</source>
        <translation>Boîtes englobantes</translation>
    </message>
    <message>
        <source>Draw the box around each model (B)</source>
        <translation>Dessiner la boîte autour de chaque modèle (B)</translation>
    </message>
    <message>
        <source>How fast mouse and keys move the camera</source>
        <translation>Vitesse à laquelle la souris et les touches déplacent la caméra</translation>
    </message>
    <message>
        <source>Size of points on the screen</source>
        <translation>Taille des points à l’écran</translation>
    </message>
    <message>
        <source>Camera speed</source>
        <translation>Vitesse</translation>
    </message>
    <message>
        <source>Point size</source>
        <translation>Points</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::VoxelPanel</name>
    <message>
        <source>As cubes</source>
        <translation>En cubes</translation>
    </message>
    <message>
        <source>Use for Voxelise</source>
        <translation>Pour Voxéliser</translation>
    </message>
    <message>
        <source>Make this the option voxel-min-points of the next runs</source>
        <translation>En faire l’option voxel-min-points des prochaines exécutions</translation>
    </message>
    <message>
        <source>Least count of a cell that is shown</source>
        <translation>Compte minimal d’une cellule affichée</translation>
    </message>
    <message>
        <source>At least</source>
        <translation>Au moins</translation>
    </message>
    <message>
        <source>%1 of %2 cells have at least %3 points</source>
        <translation>%1 cellules sur %2 ont au moins %3 points</translation>
    </message>
    <message>
        <source>Cubes</source>
        <translation>Cubes</translation>
    </message>
    <message>
        <source>Points in a cell</source>
        <translation>Points par cellule</translation>
    </message>
    <message>
        <source> and more</source>
        <translation> et plus</translation>
    </message>
    <message>
        <source>%1 of %2 cells have at least %3 lines</source>
        <translation>%1 cellules sur %2 ont au moins %3 lignes</translation>
    </message>
    <message>
        <source>Lines through a cell</source>
        <translation>Lignes par cellule</translation>
    </message>
</context>
</TS>
