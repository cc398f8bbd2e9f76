<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es_ES" sourcelanguage="en">
<context>
    <name>MessageLabel</name>
    <message>
        <source>Dismiss the message</source>
        <translation>Cerrar el mensaje</translation>
    </message>
</context>
<context>
    <name>Options</name>
    <message>
        <source>Aim height</source>
        <translation>Altura de mira</translation>
    </message>
    <message>
        <source>Aim x</source>
        <translation>Mira x</translation>
    </message>
    <message>
        <source>Aim z</source>
        <translation>Mira z</translation>
    </message>
    <message>
        <source>Albedo</source>
        <translation>Albedo</translation>
    </message>
    <message>
        <source>Align</source>
        <translation>Alinear</translation>
    </message>
    <message>
        <source>Alpha</source>
        <translation>Alfa</translation>
    </message>
    <message>
        <source>Angles</source>
        <translation>Ángulos</translation>
    </message>
    <message>
        <source>Average frames</source>
        <translation>Fotogramas promediados</translation>
    </message>
    <message>
        <source>Average share</source>
        <translation>Parte del promedio</translation>
    </message>
    <message>
        <source>Azimuth</source>
        <translation>Acimut</translation>
    </message>
    <message>
        <source>Base</source>
        <translation>Base</translation>
    </message>
    <message>
        <source>Border</source>
        <translation>Borde</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Calibración</translation>
    </message>
    <message>
        <source>Candidates</source>
        <translation>Candidatos</translation>
    </message>
    <message>
        <source>Cloud outliers</source>
        <translation>Atípicos de la nube</translation>
    </message>
    <message>
        <source>Clutter</source>
        <translation>Trastos</translation>
    </message>
    <message>
        <source>Color files</source>
        <translation>Archivos de color</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Color</translation>
    </message>
    <message>
        <source>Colour drift</source>
        <translation>Deriva del color</translation>
    </message>
    <message>
        <source>Colour fov</source>
        <translation>Campo de visión del color</translation>
    </message>
    <message>
        <source>Colour given shift</source>
        <translation>Desplazamiento indicado del color</translation>
    </message>
    <message>
        <source>Colour given turn</source>
        <translation>Giro indicado del color</translation>
    </message>
    <message>
        <source>Colour gloss</source>
        <translation>Brillo del color</translation>
    </message>
    <message>
        <source>Colour height</source>
        <translation>Alto del color</translation>
    </message>
    <message>
        <source>Colour lamp</source>
        <translation>Lámpara</translation>
    </message>
    <message>
        <source>Colour lamp azimuth</source>
        <translation>Acimut de la lámpara</translation>
    </message>
    <message>
        <source>Colour lamp elevation</source>
        <translation>Elevación de la lámpara</translation>
    </message>
    <message>
        <source>Colour noise</source>
        <translation>Ruido del color</translation>
    </message>
    <message>
        <source>Colour pan</source>
        <translation>Giro de la cámara de color</translation>
    </message>
    <message>
        <source>Colour tilt</source>
        <translation>Inclinación de la cámara de color</translation>
    </message>
    <message>
        <source>Colour vignetting</source>
        <translation>Viñeteado</translation>
    </message>
    <message>
        <source>Colour white drift</source>
        <translation>Deriva del blanco</translation>
    </message>
    <message>
        <source>Colour width</source>
        <translation>Ancho del color</translation>
    </message>
    <message>
        <source>Colour x</source>
        <translation>Cámara de color x</translation>
    </message>
    <message>
        <source>Colour y</source>
        <translation>Cámara de color y</translation>
    </message>
    <message>
        <source>Colour z</source>
        <translation>Cámara de color z</translation>
    </message>
    <message>
        <source>Coverage cell</source>
        <translation>Celda de cobertura</translation>
    </message>
    <message>
        <source>Coverage holes</source>
        <translation>Huecos de cobertura</translation>
    </message>
    <message>
        <source>Coverage thin</source>
        <translation>Cobertura escasa</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>Recorte</translation>
    </message>
    <message>
        <source>Crop below</source>
        <translation>Recorte por debajo</translation>
    </message>
    <message>
        <source>Crop beyond</source>
        <translation>Recorte por fuera</translation>
    </message>
    <message>
        <source>Crop height</source>
        <translation>Altura del recorte</translation>
    </message>
    <message>
        <source>Crop margin</source>
        <translation>Margen del recorte</translation>
    </message>
    <message>
        <source>Crop radius</source>
        <translation>Radio del recorte</translation>
    </message>
    <message>
        <source>Cut plane</source>
        <translation>Plano de corte</translation>
    </message>
    <message>
        <source>Device timeout</source>
        <translation>Espera del dispositivo</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Distancia</translation>
    </message>
    <message>
        <source>Dropped</source>
        <translation>Perdidos</translation>
    </message>
    <message>
        <source>Edge fattening</source>
        <translation>Engrosamiento de bordes</translation>
    </message>
    <message>
        <source>Elevation</source>
        <translation>Elevación</translation>
    </message>
    <message>
        <source>Exposure</source>
        <translation>Exposición</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Ajuste</translation>
    </message>
    <message>
        <source>Fit iterations</source>
        <translation>Iteraciones del ajuste</translation>
    </message>
    <message>
        <source>Fit reach</source>
        <translation>Alcance del ajuste</translation>
    </message>
    <message>
        <source>Foot</source>
        <translation>Pie</translation>
    </message>
    <message>
        <source>Fps</source>
        <translation>Fotogramas por segundo</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Fotogramas</translation>
    </message>
    <message>
        <source>Gauge ball</source>
        <translation>Bola patrón</translation>
    </message>
    <message>
        <source>Halt</source>
        <translation>Parada</translation>
    </message>
    <message>
        <source>Halt at</source>
        <translation>Momento de la parada</translation>
    </message>
    <message>
        <source>Hand</source>
        <translation>Mano</translation>
    </message>
    <message>
        <source>Hand at</source>
        <translation>Momento de la mano</translation>
    </message>
    <message>
        <source>Hand direction</source>
        <translation>Dirección de la mano</translation>
    </message>
    <message>
        <source>Hand height</source>
        <translation>Altura de la mano</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Altura</translation>
    </message>
    <message>
        <source>Hole size</source>
        <translation>Tamaño de huecos</translation>
    </message>
    <message>
        <source>Holes</source>
        <translation>Huecos</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Conservar</translation>
    </message>
    <message>
        <source>Keep box</source>
        <translation>Conservar la caja</translation>
    </message>
    <message>
        <source>Knock</source>
        <translation>Golpe</translation>
    </message>
    <message>
        <source>Knock at</source>
        <translation>Momento del golpe</translation>
    </message>
    <message>
        <source>Knock direction</source>
        <translation>Dirección del golpe</translation>
    </message>
    <message>
        <source>Knock pan</source>
        <translation>Giro por el golpe</translation>
    </message>
    <message>
        <source>Knock tilt</source>
        <translation>Inclinación por el golpe</translation>
    </message>
    <message>
        <source>Lean</source>
        <translation>Inclinación</translation>
    </message>
    <message>
        <source>Mark invented</source>
        <translation>Marcar lo inventado</translation>
    </message>
    <message>
        <source>Max error</source>
        <translation>Error máximo</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Método</translation>
    </message>
    <message>
        <source>Min free</source>
        <translation>Mínimo libre (bytes)</translation>
    </message>
    <message>
        <source>Min object share</source>
        <translation>Parte mínima de un objeto</translation>
    </message>
    <message>
        <source>Mixed pixels</source>
        <translation>Píxeles mixtos</translation>
    </message>
    <message>
        <source>Mixed reach</source>
        <translation>Alcance de píxeles mixtos</translation>
    </message>
    <message>
        <source>Motion angle sigma</source>
        <translation>Sigma del ángulo</translation>
    </message>
    <message>
        <source>Motion angles</source>
        <translation>Ángulos por movimiento</translation>
    </message>
    <message>
        <source>Motion keys</source>
        <translation>Claves del movimiento</translation>
    </message>
    <message>
        <source>Motion table</source>
        <translation>Mesa por movimiento</translation>
    </message>
    <message>
        <source>Motor baud</source>
        <translation>Baudios del motor</translation>
    </message>
    <message>
        <source>Motor boot</source>
        <translation>Arranque del motor</translation>
    </message>
    <message>
        <source>Motor max speed</source>
        <translation>Velocidad máxima del motor</translation>
    </message>
    <message>
        <source>Motor protocol</source>
        <translation>Protocolo del motor</translation>
    </message>
    <message>
        <source>Motor reversed</source>
        <translation>Motor invertido</translation>
    </message>
    <message>
        <source>Motor timeout</source>
        <translation>Espera del motor</translation>
    </message>
    <message>
        <source>Motor units</source>
        <translation>Unidades del motor</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Ruido</translation>
    </message>
    <message>
        <source>Noise window</source>
        <translation>Ventana del ruido</translation>
    </message>
    <message>
        <source>Normal radius</source>
        <translation>Radio de las normales</translation>
    </message>
    <message>
        <source>Object gap</source>
        <translation>Separación entre objetos</translation>
    </message>
    <message>
        <source>Object move</source>
        <translation>Desplazamiento del objeto</translation>
    </message>
    <message>
        <source>Object move at</source>
        <translation>Momento del desplazamiento</translation>
    </message>
    <message>
        <source>Object move direction</source>
        <translation>Dirección del desplazamiento</translation>
    </message>
    <message>
        <source>Object move tip</source>
        <translation>Vuelco del desplazamiento</translation>
    </message>
    <message>
        <source>Object move turn</source>
        <translation>Giro del desplazamiento</translation>
    </message>
    <message>
        <source>Object x</source>
        <translation>Objeto x</translation>
    </message>
    <message>
        <source>Object z</source>
        <translation>Objeto z</translation>
    </message>
    <message>
        <source>Only object</source>
        <translation>Solo el objeto</translation>
    </message>
    <message>
        <source>Outlier k</source>
        <translation>Vecinos de atípicos</translation>
    </message>
    <message>
        <source>Outlier lambda</source>
        <translation>Lambda de atípicos</translation>
    </message>
    <message>
        <source>Outliers</source>
        <translation>Atípicos</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Solape</translation>
    </message>
    <message>
        <source>Pass</source>
        <translation>Pasada</translation>
    </message>
    <message>
        <source>Platter</source>
        <translation>Plato</translation>
    </message>
    <message>
        <source>Platter confidence</source>
        <translation>Confianza del plato</translation>
    </message>
    <message>
        <source>Platter max radius</source>
        <translation>Radio máximo del plato</translation>
    </message>
    <message>
        <source>Platter min radius</source>
        <translation>Radio mínimo del plato</translation>
    </message>
    <message>
        <source>Platter radius</source>
        <translation>Radio del plato</translation>
    </message>
    <message>
        <source>Platter rim</source>
        <translation>Borde del plato</translation>
    </message>
    <message>
        <source>Platter thickness</source>
        <translation>Grosor del plato</translation>
    </message>
    <message>
        <source>Poisson depth</source>
        <translation>Profundidad de Poisson</translation>
    </message>
    <message>
        <source>Poisson point weight</source>
        <translation>Peso de puntos de Poisson</translation>
    </message>
    <message>
        <source>Poisson samples</source>
        <translation>Muestras de Poisson</translation>
    </message>
    <message>
        <source>Poisson scale</source>
        <translation>Escala de Poisson</translation>
    </message>
    <message>
        <source>Record queue</source>
        <translation>Cola de grabación</translation>
    </message>
    <message>
        <source>Record threads</source>
        <translation>Hilos de grabación</translation>
    </message>
    <message>
        <source>Refine</source>
        <translation>Refinar</translation>
    </message>
    <message>
        <source>Refine colour camera</source>
        <translation>Refinar la cámara de color</translation>
    </message>
    <message>
        <source>Refine iterations</source>
        <translation>Iteraciones del refinamiento</translation>
    </message>
    <message>
        <source>Refine radius</source>
        <translation>Radio del refinamiento</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Reparar</translation>
    </message>
    <message>
        <source>Ripple</source>
        <translation>Rizado</translation>
    </message>
    <message>
        <source>Ripple cycles</source>
        <translation>Ciclos del rizado</translation>
    </message>
    <message>
        <source>Roll</source>
        <translation>Alabeo</translation>
    </message>
    <message>
        <source>Room</source>
        <translation>Habitación</translation>
    </message>
    <message>
        <source>Runout</source>
        <translation>Descentrado</translation>
    </message>
    <message>
        <source>Runout cycles</source>
        <translation>Ciclos del descentrado</translation>
    </message>
    <message>
        <source>Sample seed</source>
        <translation>Semilla de muestras</translation>
    </message>
    <message>
        <source>Samples</source>
        <translation>Muestras</translation>
    </message>
    <message>
        <source>Scan colour</source>
        <translation>Escanear color</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>Segundos</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Semilla</translation>
    </message>
    <message>
        <source>Settle</source>
        <translation>Reposo</translation>
    </message>
    <message>
        <source>Sharpen</source>
        <translation>Enfocar</translation>
    </message>
    <message>
        <source>Slip</source>
        <translation>Deslizamiento</translation>
    </message>
    <message>
        <source>Slip at</source>
        <translation>Momento del deslizamiento</translation>
    </message>
    <message>
        <source>Smallest part</source>
        <translation>Parte más pequeña</translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation>Suavizar</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Velocidad</translation>
    </message>
    <message>
        <source>Start delay</source>
        <translation>Retardo de arranque</translation>
    </message>
    <message>
        <source>Start ramp</source>
        <translation>Rampa de arranque</translation>
    </message>
    <message>
        <source>Stop frames</source>
        <translation>Fotogramas por parada</translation>
    </message>
    <message>
        <source>Stop ramp</source>
        <translation>Rampa de parada</translation>
    </message>
    <message>
        <source>Stops</source>
        <translation>Paradas</translation>
    </message>
    <message>
        <source>Sub voxel line</source>
        <translation>Línea de subvóxeles</translation>
    </message>
    <message>
        <source>Sub voxels</source>
        <translation>Subvóxeles</translation>
    </message>
    <message>
        <source>Table tilt</source>
        <translation>Inclinación de la mesa</translation>
    </message>
    <message>
        <source>Table tilt direction</source>
        <translation>Dirección de la inclinación</translation>
    </message>
    <message>
        <source>Table x</source>
        <translation>Mesa x</translation>
    </message>
    <message>
        <source>Table y</source>
        <translation>Mesa y</translation>
    </message>
    <message>
        <source>Table z</source>
        <translation>Mesa z</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Textura</translation>
    </message>
    <message>
        <source>Texture size</source>
        <translation>Tamaño de la textura</translation>
    </message>
    <message>
        <source>Thresholds</source>
        <translation>Umbrales</translation>
    </message>
    <message>
        <source>Tip</source>
        <translation>Vuelco</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>Tolerancia</translation>
    </message>
    <message>
        <source>Travel</source>
        <translation>Recorrido</translation>
    </message>
    <message>
        <source>Travel along</source>
        <translation>Dirección del recorrido</translation>
    </message>
    <message>
        <source>Triangles</source>
        <translation>Triángulos</translation>
    </message>
    <message>
        <source>Truncation</source>
        <translation>Truncamiento</translation>
    </message>
    <message>
        <source>Turns</source>
        <translation>Vueltas</translation>
    </message>
    <message>
        <source>Until stopped</source>
        <translation>Hasta detener</translation>
    </message>
    <message>
        <source>Voxel grid</source>
        <translation>Rejilla de vóxeles</translation>
    </message>
    <message>
        <source>Voxel min points</source>
        <translation>Puntos mínimos por vóxel</translation>
    </message>
    <message>
        <source>Voxel size</source>
        <translation>Tamaño de vóxel</translation>
    </message>
    <message>
        <source>Warm up</source>
        <translation>Calentamiento</translation>
    </message>
    <message>
        <source>Warm up time</source>
        <translation>Tiempo de calentamiento</translation>
    </message>
    <message>
        <source>Wiggling</source>
        <translation>Ondulación</translation>
    </message>
    <message>
        <source>Wiggling period</source>
        <translation>Periodo de la ondulación</translation>
    </message>
    <message>
        <source>Wobble</source>
        <translation>Bamboleo</translation>
    </message>
    <message>
        <source>Wobble cycles</source>
        <translation>Ciclos del bamboleo</translation>
    </message>
    <message>
        <source>Yaw</source>
        <translation>Giro</translation>
    </message>
    <message>
        <source>Ball</source>
        <translation>Bola</translation>
    </message>
    <message>
        <source>Ball bar</source>
        <translation>Barra de bolas</translation>
    </message>
    <message>
        <source>Colour camera</source>
        <translation>Cámara de color</translation>
    </message>
    <message>
        <source>Covered</source>
        <translation>Cubierto</translation>
    </message>
    <message>
        <source>Cylinder</source>
        <translation>Cilindro</translation>
    </message>
    <message>
        <source>Doll</source>
        <translation>Muñeca</translation>
    </message>
    <message>
        <source>Emitter blocked</source>
        <translation>Emisor tapado</translation>
    </message>
    <message>
        <source>Grazing</source>
        <translation>Rasante</translation>
    </message>
    <message>
        <source>Letter a</source>
        <translation>Letra A</translation>
    </message>
    <message>
        <source>Missed</source>
        <translation>Sin cubrir</translation>
    </message>
    <message>
        <source>Motion of the turntable</source>
        <translation>Movimiento de la mesa giratoria</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Ninguno</translation>
    </message>
    <message>
        <source>Nothing</source>
        <translation>Nada</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objeto</translation>
    </message>
    <message>
        <source>Out of view</source>
        <translation>Fuera de la vista</translation>
    </message>
    <message>
        <source>Place of the scanners</source>
        <translation>Posición de los escáneres</translation>
    </message>
    <message>
        <source>Plate</source>
        <translation>Placa</translation>
    </message>
    <message>
        <source>Receiver blocked</source>
        <translation>Receptor tapado</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Grabación</translation>
    </message>
    <message>
        <source>Rejected</source>
        <translation>Rechazado</translation>
    </message>
    <message>
        <source>Scorpion</source>
        <translation>Escorpión</translation>
    </message>
    <message>
        <source>Skull</source>
        <translation>Cráneo</translation>
    </message>
    <message>
        <source>Thin</source>
        <translation>Escaso</translation>
    </message>
    <message>
        <source>Too dark</source>
        <translation>Demasiado oscuro</translation>
    </message>
    <message>
        <source>Too far</source>
        <translation>Demasiado lejos</translation>
    </message>
    <message>
        <source>Too near</source>
        <translation>Demasiado cerca</translation>
    </message>
    <message>
        <source>Turntable</source>
        <translation>Mesa giratoria</translation>
    </message>
    <message>
        <source>Unreachable</source>
        <translation>Inalcanzable</translation>
    </message>
    <message>
        <source>Events during the recording</source>
        <translation>Lo que ocurre mientras</translation>
    </message>
    <message>
        <source>Color quality</source>
        <translation>Calidad del color</translation>
    </message>
    <message>
        <source>Labelled cylinder</source>
        <translation>Cilindro con etiqueta</translation>
    </message>
    <message>
        <source>Action figure</source>
        <translation>Figura de acción</translation>
    </message>
    <message>
        <source>Aspect</source>
        <translation>Relación de aspecto</translation>
    </message>
    <message>
        <source>Axial constant</source>
        <translation>Axial, constante</translation>
    </message>
    <message>
        <source>Axial grazing</source>
        <translation>Axial, rasante</translation>
    </message>
    <message>
        <source>Axial grazing from</source>
        <translation>Axial, rasante desde</translation>
    </message>
    <message>
        <source>Axial grazing power</source>
        <translation>Axial, rasante, potencia</translation>
    </message>
    <message>
        <source>Axial linear</source>
        <translation>Axial, lineal</translation>
    </message>
    <message>
        <source>Axial linear from</source>
        <translation>Axial, lineal desde</translation>
    </message>
    <message>
        <source>Axial quadratic</source>
        <translation>Axial, cuadrático</translation>
    </message>
    <message>
        <source>Axial quadratic at</source>
        <translation>Axial, cuadrático en</translation>
    </message>
    <message>
        <source>Baseline</source>
        <translation>Línea base</translation>
    </message>
    <message>
        <source>Baseline direction</source>
        <translation>Dirección de la línea base</translation>
    </message>
    <message>
        <source>Bias</source>
        <translation>Sesgo</translation>
    </message>
    <message>
        <source>Colour delay</source>
        <translation>Retraso del color</translation>
    </message>
    <message>
        <source>Colour jitter</source>
        <translation>Fluctuación del color</translation>
    </message>
    <message>
        <source>Columns</source>
        <translation>Columnas</translation>
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
        <translation>Fluctuación en lo oscuro</translation>
    </message>
    <message>
        <source>Dark signal</source>
        <translation>Señal en lo oscuro</translation>
    </message>
    <message>
        <source>Depth unit</source>
        <translation>Unidad de profundidad</translation>
    </message>
    <message>
        <source>Disparity sigma</source>
        <translation>Disparidad, sigma</translation>
    </message>
    <message>
        <source>Disparity step</source>
        <translation>Disparidad, paso</translation>
    </message>
    <message>
        <source>Drop from</source>
        <translation>Se pierde desde</translation>
    </message>
    <message>
        <source>Drop to</source>
        <translation>Se pierde hasta</translation>
    </message>
    <message>
        <source>Far</source>
        <translation>Lejos</translation>
    </message>
    <message>
        <source>Footprint px</source>
        <translation>Huella, px</translation>
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
        <translation>Tipo</translation>
    </message>
    <message>
        <source>Lateral grazing px</source>
        <translation>Lateral, rasante, px</translation>
    </message>
    <message>
        <source>Lateral length</source>
        <translation>Lateral, longitud</translation>
    </message>
    <message>
        <source>Lateral per metre</source>
        <translation>Lateral por metro</translation>
    </message>
    <message>
        <source>Lateral px</source>
        <translation>Lateral, px</translation>
    </message>
    <message>
        <source>Line aperture</source>
        <translation>Línea, apertura</translation>
    </message>
    <message>
        <source>Line blur</source>
        <translation>Línea, desenfoque</translation>
    </message>
    <message>
        <source>Line contrast</source>
        <translation>Línea, contraste</translation>
    </message>
    <message>
        <source>Line exposure</source>
        <translation>Línea, exposición</translation>
    </message>
    <message>
        <source>Line focal</source>
        <translation>Línea, focal</translation>
    </message>
    <message>
        <source>Line full well</source>
        <translation>Línea, capacidad del píxel</translation>
    </message>
    <message>
        <source>Line read noise</source>
        <translation>Línea, ruido de lectura</translation>
    </message>
    <message>
        <source>Line threshold</source>
        <translation>Línea, umbral</translation>
    </message>
    <message>
        <source>Line wavelength</source>
        <translation>Línea, longitud de onda</translation>
    </message>
    <message>
        <source>Line width</source>
        <translation>Línea, anchura</translation>
    </message>
    <message>
        <source>Max incidence</source>
        <translation>Incidencia máxima</translation>
    </message>
    <message>
        <source>Mixed rejection</source>
        <translation>Rechazo de píxeles mixtos</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nombre</translation>
    </message>
    <message>
        <source>Near</source>
        <translation>Cerca</translation>
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
        <translation>Giro a la derecha</translation>
    </message>
    <message>
        <source>Physics</source>
        <translation>Física</translation>
    </message>
    <message>
        <source>Robed figure</source>
        <translation>Figura con túnica</translation>
    </message>
    <message>
        <source>Rows</source>
        <translation>Filas</translation>
    </message>
    <message>
        <source>Sensing</source>
        <translation>Medición</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Inclinación hacia arriba</translation>
    </message>
    <message>
        <source>Tof amplitude</source>
        <translation>ToF, amplitud</translation>
    </message>
    <message>
        <source>Tof read noise</source>
        <translation>ToF, ruido de lectura</translation>
    </message>
    <message>
        <source>Tof relative noise</source>
        <translation>ToF, ruido relativo</translation>
    </message>
    <message>
        <source>Tof shot noise</source>
        <translation>ToF, ruido de disparo</translation>
    </message>
    <message>
        <source>Vertical fov</source>
        <translation>Campo de visión vertical</translation>
    </message>
    <message>
        <source>Voxel grid in bounds</source>
        <translation>Rejilla en los límites de los puntos</translation>
    </message>
    <message>
        <source>Window agreement</source>
        <translation>Ventana, concordancia</translation>
    </message>
    <message>
        <source>Window dots</source>
        <translation>Ventana, puntos</translation>
    </message>
    <message>
        <source>Window px</source>
        <translation>Ventana, px</translation>
    </message>
    <message>
        <source>Window share</source>
        <translation>Ventana, proporción</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>Error, mm</source>
        <translation>Error, mm</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>media</translation>
    </message>
    <message>
        <source>median</source>
        <translation>mediana</translation>
    </message>
    <message>
        <source>p95</source>
        <translation>p95</translation>
    </message>
    <message>
        <source>max</source>
        <translation>máx.</translation>
    </message>
    <message>
        <source>Accuracy</source>
        <translation>Exactitud</translation>
    </message>
    <message>
        <source>Completeness</source>
        <translation>Compleción</translation>
    </message>
    <message>
        <source>Within</source>
        <translation>Dentro de</translation>
    </message>
    <message>
        <source>precision</source>
        <translation>precisión</translation>
    </message>
    <message>
        <source>recall</source>
        <translation>exhaustividad</translation>
    </message>
    <message>
        <source>distance to %1</source>
        <translation>distancia a %1</translation>
    </message>
    <message>
        <source>Millimetres</source>
        <translation>Milímetros</translation>
    </message>
    <message>
        <source>Centimetres</source>
        <translation>Centímetros</translation>
    </message>
    <message>
        <source>Inches</source>
        <translation>Pulgadas</translation>
    </message>
    <message>
        <source>Metres</source>
        <translation>Metros</translation>
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
        <translation>¿Qué unidad?</translation>
    </message>
    <message>
        <source>%1 does not say its unit. Read in %2 it is %3 large. In which unit is it?</source>
        <translation>%1 no indica su unidad. Leído en %2 mide %3. ¿En qué unidad está?</translation>
    </message>
    <message>
        <source>Distance to %1</source>
        <translation>Distancia a %1</translation>
    </message>
    <message>
        <source> and more</source>
        <translation> y más</translation>
    </message>
    <message>
        <source>empty</source>
        <translation>vacío</translation>
    </message>
    <message>
        <source>%1 vertices, %2 triangles in %3
%4
Area %5 cm²</source>
        <translation>%1 vértices, %2 triángulos en %3
%4
Área %5 cm²</translation>
    </message>
    <message>
        <source>1 piece</source>
        <translation>1 pieza</translation>
    </message>
    <message>
        <source>%1 pieces</source>
        <translation>%1 piezas</translation>
    </message>
    <message>
        <source>
Texture of %1 × %2 texels</source>
        <translation>
Textura de %1 × %2 téxeles</translation>
    </message>
    <message>
        <source>, volume %1 cm³</source>
        <translation>, volumen %1 cm³</translation>
    </message>
    <message>
        <source>%1 points%2%3
%4</source>
        <translation>%1 puntos%2%3
%4</translation>
    </message>
    <message>
        <source>, with normals</source>
        <translation>, con normales</translation>
    </message>
    <message>
        <source>, with colours</source>
        <translation>, con colores</translation>
    </message>
    <message>
        <source>%1 triangles</source>
        <translation>%1 triángulos</translation>
    </message>
    <message>
        <source>%1 points</source>
        <translation>%1 puntos</translation>
    </message>
    <message>
        <source>%1 frames</source>
        <translation>%1 fotogramas</translation>
    </message>
    <message>
        <source>View of each place</source>
        <translation>Vista de cada lugar</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>Recorte</translation>
    </message>
    <message>
        <source>Statistical filter</source>
        <translation>Filtro estadístico</translation>
    </message>
    <message>
        <source>Merge</source>
        <translation>Fusión</translation>
    </message>
    <message>
        <source>Voxelisation</source>
        <translation>Voxelización</translation>
    </message>
    <message>
        <source>Candidate points</source>
        <translation>Puntos candidatos</translation>
    </message>
    <message>
        <source>Objects</source>
        <translation>Objetos</translation>
    </message>
    <message>
        <source>Normals</source>
        <translation>Normales</translation>
    </message>
    <message>
        <source>Refinement</source>
        <translation>Refinamiento</translation>
    </message>
    <message>
        <source>Base</source>
        <translation>Base</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Malla</translation>
    </message>
    <message>
        <source>Volumetric mesh</source>
        <translation>Malla volumétrica</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>Acabado</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Textura</translation>
    </message>
    <message>
        <source>Merge the frames</source>
        <translation>Fusionar los fotogramas</translation>
    </message>
    <message>
        <source>Voxelise</source>
        <translation>Voxelizar</translation>
    </message>
    <message>
        <source>Find candidates</source>
        <translation>Buscar candidatos</translation>
    </message>
    <message>
        <source>Refine candidates</source>
        <translation>Refinar candidatos</translation>
    </message>
    <message>
        <source>Oriented points</source>
        <translation>Puntos orientados</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 de %2</translation>
    </message>
    <message>
        <source>%1 mesh</source>
        <translation>malla de %1</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>%1 was not joined: %2; its mesh is a model of its own</source>
        <translation>%1 no se unió: %2; su malla es un modelo aparte</translation>
    </message>
    <message>
        <source>
Note: %1</source>
        <translation>
Nota: %1</translation>
    </message>
    <message>
        <source>%1 of %2 points were dropped</source>
        <translation>Se descartaron %1 de %2 puntos</translation>
    </message>
    <message>
        <source>filter of %1</source>
        <translation>filtro de %1</translation>
    </message>
    <message>
        <source>frame %1, from %2°: %3 %</source>
        <translation>fotograma %1, desde %2°: %3 %</translation>
    </message>
    <message>
        <source>no view, filled: %1 %</source>
        <translation>sin vista, rellenado: %1 %</translation>
    </message>
    <message>
        <source>Above the plane</source>
        <translation>Sobre el plano</translation>
    </message>
    <message>
        <source>Seen from</source>
        <translation>Visto desde</translation>
    </message>
    <message>
        <source>1 side</source>
        <translation>1 lado</translation>
    </message>
    <message>
        <source>2 sides</source>
        <translation>2 lados</translation>
    </message>
    <message>
        <source>%1 or more</source>
        <translation>%1 o más</translation>
    </message>
    <message>
        <source>nowhere yet</source>
        <translation>ninguno aún</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>desconocido</translation>
    </message>
    <message>
        <source>Share of the surface</source>
        <translation>Parte de la superficie</translation>
    </message>
    <message>
        <source>Samples per mm²</source>
        <translation>Muestras por mm²</translation>
    </message>
    <message>
        <source>Without a sample</source>
        <translation>Sin muestras</translation>
    </message>
    <message>
        <source>Has samples</source>
        <translation>Con muestras</translation>
    </message>
    <message>
        <source>Rig</source>
        <translation>Montaje</translation>
    </message>
    <message>
        <source>View of a scanner</source>
        <translation>Campo de visión de un escáner</translation>
    </message>
    <message>
        <source>Emitter</source>
        <translation>Emisor</translation>
    </message>
    <message>
        <source>Receiver</source>
        <translation>Receptor</translation>
    </message>
    <message>
        <source>Rim, and the way it turns</source>
        <translation>Borde y sentido de giro</translation>
    </message>
    <message>
        <source>Front	1</source>
        <translation>Frente	1</translation>
    </message>
    <message>
        <source>Back	2</source>
        <translation>Atrás	2</translation>
    </message>
    <message>
        <source>Left	3</source>
        <translation>Izquierda	3</translation>
    </message>
    <message>
        <source>Right	4</source>
        <translation>Derecha	4</translation>
    </message>
    <message>
        <source>Top	5</source>
        <translation>Arriba	5</translation>
    </message>
    <message>
        <source>Bottom	6</source>
        <translation>Abajo	6</translation>
    </message>
    <message>
        <source>Corner	7</source>
        <translation>Esquina	7</translation>
    </message>
    <message>
        <source>Reset camera</source>
        <translation>Encuadrar todo</translation>
    </message>
    <message>
        <source>Show everything (Home)</source>
        <translation>Mostrar todo (Inicio)</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Vistas</translation>
    </message>
    <message>
        <source>Look from one side (1 to 7)</source>
        <translation>Mirar desde un lado (1 a 7)</translation>
    </message>
    <message>
        <source>&lt;br&gt;From %1 to %2</source>
        <translation>&lt;br&gt;De %1 a %2</translation>
    </message>
    <message>
        <source>%1 s left</source>
        <translation>quedan %1 s</translation>
    </message>
    <message>
        <source>%1 min %2 s left</source>
        <translation>quedan %1 min %2 s</translation>
    </message>
    <message>
        <source>Quit?</source>
        <translation>¿Salir?</translation>
    </message>
    <message>
        <source>Quit without saving</source>
        <translation>Salir sin guardar</translation>
    </message>
    <message>
        <source>Stay</source>
        <translation>Quedarse</translation>
    </message>
    <message>
        <source>%1, %2 dropped</source>
        <translation>%1, %2 perdidos</translation>
    </message>
    <message>
        <source>Probe</source>
        <translation>Sonda</translation>
    </message>
    <message>
        <source>The deviation from the reference at a place</source>
        <translation>La desviación respecto a la referencia en un lugar</translation>
    </message>
    <message>
        <source>Click on a model whose deviations are shown</source>
        <translation>Haga clic en un modelo cuyas desviaciones se muestran</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Distancia</translation>
    </message>
    <message>
        <source>Distance between two places</source>
        <translation>Entre dos lugares</translation>
    </message>
    <message>
        <source>Click two places on models</source>
        <translation>Haga clic en dos lugares de los modelos</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Ángulo</translation>
    </message>
    <message>
        <source>Angle at a corner between the directions to two places</source>
        <translation>Entre los caminos de un vértice a dos lugares</translation>
    </message>
    <message>
        <source>Click a place, the corner, and another place</source>
        <translation>Haga clic en un lugar, en el vértice y en otro lugar</translation>
    </message>
    <message>
        <source>Circle</source>
        <translation>Círculo</translation>
    </message>
    <message>
        <source>Diameter of the circle through three places</source>
        <translation>Diámetro del círculo que pasa por tres lugares</translation>
    </message>
    <message>
        <source>Click three places on the circle</source>
        <translation>Haga clic en tres lugares del círculo</translation>
    </message>
    <message>
        <source>Plane</source>
        <translation>Plano</translation>
    </message>
    <message>
        <source>How flat the surface around a place is</source>
        <translation>Lo plana que es la superficie alrededor de un lugar</translation>
    </message>
    <message>
        <source>Click on a flat part of the selected model</source>
        <translation>Haga clic en una parte plana del modelo seleccionado</translation>
    </message>
    <message>
        <source>Thickness</source>
        <translation>Espesor</translation>
    </message>
    <message>
        <source>Thickness of the wall behind a place, perpendicular to it</source>
        <translation>De la pared detrás de un lugar, en perpendicular a él</translation>
    </message>
    <message>
        <source>Click on the selected model</source>
        <translation>Haga clic en el modelo seleccionado</translation>
    </message>
    <message>
        <source>
The command line makes it with%1 --refine-pass-poses</source>
        <translation>
La línea de órdenes lo hace con%1 --refine-pass-poses</translation>
    </message>
    <message>
        <source>pass %1: %2</source>
        <translation>pasada %1: %2</translation>
    </message>
    <message>
        <source>%1 of pass %2</source>
        <translation>%1 de la pasada %2</translation>
    </message>
    <message>
        <source>Not measured</source>
        <translation>Sin medir</translation>
    </message>
    <message>
        <source>no view saw it</source>
        <translation>ninguna vista lo vio</translation>
    </message>
    <message>
        <source>Nearly all of its surface was seen.</source>
        <translation>Se vio casi toda su superficie.</translation>
    </message>
    <message>
        <source>Count contributions</source>
        <translation>Contar contribuciones</translation>
    </message>
    <message>
        <source>Put nothing on the table and press Calibrate; or record at once: the object&apos;s motion shows where the table is.</source>
        <translation>No ponga nada en la mesa y pulse Calibrar; o grabe sin más: el movimiento del objeto muestra dónde está la mesa.</translation>
    </message>
    <message>
        <source>%1 %2 (default %3)</source>
        <translation>%1 %2 (por defecto %3)</translation>
    </message>
    <message>
        <source>Made with the defaults</source>
        <translation>Hecho con los valores por defecto</translation>
    </message>
    <message>
        <source>Made with</source>
        <translation>Hecho con</translation>
    </message>
    <message>
        <source>
Found from the data</source>
        <translation>
Según los datos</translation>
    </message>
    <message>
        <source>
Edited or duplicated since</source>
        <translation>
Editado o duplicado después</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ComparePanel</name>
    <message>
        <source>Options of distances</source>
        <translation>Opciones de las distancias</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referencia</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modelo</translation>
    </message>
    <message>
        <source>Side by side</source>
        <translation>Lado a lado</translation>
    </message>
    <message>
        <source>Both with one camera</source>
        <translation>Los dos con una misma cámara</translation>
    </message>
    <message>
        <source>Overlay</source>
        <translation>Superponer</translation>
    </message>
    <message>
        <source>One over the other</source>
        <translation>Uno sobre el otro</translation>
    </message>
    <message>
        <source>Distances</source>
        <translation>Distancias</translation>
    </message>
    <message>
        <source>Colour the model by its distance to the reference</source>
        <translation>Colorear el modelo según su distancia a la referencia</translation>
    </message>
    <message>
        <source>Distances are to a mesh: choose one as the reference.</source>
        <translation>Las distancias se miden a una malla: elija una como referencia.</translation>
    </message>
    <message>
        <source>%1 is %2 times as large as %3: are both in the same unit?</source>
        <translation>%1 es %2 veces más grande que %3: ¿están ambos en la misma unidad?</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::DeviationPanel</name>
    <message>
        <source>What deviates by less is grey: it is in tolerance</source>
        <translation>Lo que se desvía menos es gris: está dentro de la tolerancia</translation>
    </message>
    <message>
        <source>The deviation of the darkest colours; automatic: 95 of 100 vertices deviate less</source>
        <translation>La desviación de los colores más oscuros; automático: 95 de cada 100 vértices se desvían menos</translation>
    </message>
    <message>
        <source>Deviations</source>
        <translation>Desviaciones</translation>
    </message>
    <message>
        <source>Colour the selected model by its signed distance to the reference: red outside of it, blue inside</source>
        <translation>Colorear el modelo seleccionado por su distancia con signo a la referencia: rojo fuera de ella, azul dentro</translation>
    </message>
    <message>
        <source>Align to it</source>
        <translation>Alinear con ella</translation>
    </message>
    <message>
        <source>Move the selected model rigidly onto the reference, from where it lies</source>
        <translation>Mover el modelo seleccionado rígidamente sobre la referencia, desde donde está</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Ocultar</translation>
    </message>
    <message>
        <source>Show the model in its own colours again</source>
        <translation>Volver a mostrar el modelo con sus propios colores</translation>
    </message>
    <message>
        <source>Export CSV…</source>
        <translation>Exportar CSV…</translation>
    </message>
    <message>
        <source>The deviation of each vertex or point</source>
        <translation>La desviación de cada vértice o punto</translation>
    </message>
    <message>
        <source>Reference of deviations</source>
        <translation>Referencia de las desviaciones</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>automático</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referencia</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>Tolerancia</translation>
    </message>
    <message>
        <source>Range of colours</source>
        <translation>Intervalo de los colores</translation>
    </message>
    <message>
        <source>Deviation from %1</source>
        <translation>Desviación respecto a %1</translation>
    </message>
    <message>
        <source>Colour the deviations</source>
        <translation>Colorear las desviaciones</translation>
    </message>
    <message>
        <source>%1 to %2: mean %3, rms %4, from %5 to %6 mm. Within ±%7 mm %8 %, above %9 %, below %10 %. The reference is not drawn meanwhile.</source>
        <translation>%1 respecto a %2: media %3, rms %4, de %5 a %6 mm. Dentro de ±%7 mm %8 %, por encima %9 %, por debajo %10 %. La referencia no se dibuja entretanto.</translation>
    </message>
    <message>
        <source>Align</source>
        <translation>Alinear</translation>
    </message>
    <message>
        <source>align %1</source>
        <translation>alinear %1</translation>
    </message>
    <message>
        <source>%1 to %2: </source>
        <translation>%1 con %2: </translation>
    </message>
    <message>
        <source>Export deviations</source>
        <translation>Exportar las desviaciones</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>Tabla (*.csv)</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>Exportar %1</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Se escribió %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::EditPanel</name>
    <message>
        <source>Rectangle</source>
        <translation>Rectángulo</translation>
    </message>
    <message>
        <source>Select what a rectangle on the screen encloses</source>
        <translation>Seleccionar lo que encierra un rectángulo en la pantalla</translation>
    </message>
    <message>
        <source>Lasso</source>
        <translation>Lazo</translation>
    </message>
    <message>
        <source>Select what an outline on the screen encloses</source>
        <translation>Seleccionar lo que encierra un contorno en la pantalla</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pincel</translation>
    </message>
    <message>
        <source>Select what is painted over</source>
        <translation>Seleccionar lo que se pinta</translation>
    </message>
    <message>
        <source>; with Shift it is added, with Ctrl subtracted, with Alt the mouse turns the camera</source>
        <translation>; con Mayús se añade, con Ctrl se quita, con Alt el ratón gira la cámara</translation>
    </message>
    <message>
        <source>Select</source>
        <translation>Seleccionar</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Añadir</translation>
    </message>
    <message>
        <source>Subtract</source>
        <translation>Quitar</translation>
    </message>
    <message>
        <source>What the tool does with what was selected before</source>
        <translation>Qué hace la herramienta con lo que estaba seleccionado antes</translation>
    </message>
    <message>
        <source>Through</source>
        <translation>A través</translation>
    </message>
    <message>
        <source>Select what is hidden behind other parts, too</source>
        <translation>Seleccionar también lo que está oculto detrás de otras partes</translation>
    </message>
    <message>
        <source>Radius of the brush on the screen</source>
        <translation>Radio del pincel en la pantalla</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Todo</translation>
    </message>
    <message>
        <source>Select the whole model</source>
        <translation>Seleccionar el modelo entero</translation>
    </message>
    <message>
        <source>Invert</source>
        <translation>Invertir</translation>
    </message>
    <message>
        <source>Select what is not selected</source>
        <translation>Seleccionar lo que no está seleccionado</translation>
    </message>
    <message>
        <source>Nothing</source>
        <translation>Nada</translation>
    </message>
    <message>
        <source>Forget the selection</source>
        <translation>Olvidar la selección</translation>
    </message>
    <message>
        <source>Grow</source>
        <translation>Ampliar</translation>
    </message>
    <message>
        <source>Add the neighbours of what is selected</source>
        <translation>Añadir los vecinos de lo seleccionado</translation>
    </message>
    <message>
        <source>Shrink</source>
        <translation>Reducir</translation>
    </message>
    <message>
        <source>Leave out the rim of the selection</source>
        <translation>Dejar fuera el borde de la selección</translation>
    </message>
    <message>
        <source>Connected</source>
        <translation>Conectado</translation>
    </message>
    <message>
        <source>Add everything that is connected to the selection</source>
        <translation>Añadir todo lo que está unido a lo seleccionado</translation>
    </message>
    <message>
        <source>Delete selected</source>
        <translation>Borrar lo seleccionado</translation>
    </message>
    <message>
        <source>Delete what is selected (Del)</source>
        <translation>Borrar lo que está seleccionado (Supr)</translation>
    </message>
    <message>
        <source>Fill holes</source>
        <translation>Rellenar agujeros</translation>
    </message>
    <message>
        <source>Close the holes beside the selection; without one, all</source>
        <translation>Cerrar los agujeros junto a la selección; sin selección, todos</translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation>Suavizar</translation>
    </message>
    <message>
        <source>Smooth waves shorter than this in the selection; without one, in the whole mesh</source>
        <translation>Quitar de la selección las ondas más cortas que esto; sin selección, de toda la malla</translation>
    </message>
    <message>
        <source>Reduce to</source>
        <translation>Reducir a</translation>
    </message>
    <message>
        <source>Reduce to this number by merging triangles of the selection; without one, of the whole mesh</source>
        <translation>Tantos triángulos, uniendo los de la selección; sin selección, todos</translation>
    </message>
    <message>
        <source>Waves of this length lose half of their height</source>
        <translation>Las ondas de esta longitud pierden la mitad de su altura</translation>
    </message>
    <message>
        <source>Triangles of the whole mesh afterwards</source>
        <translation>Triángulos de toda la malla después</translation>
    </message>
    <message>
        <source>Flat cut</source>
        <translation>Corte plano</translation>
    </message>
    <message>
        <source>Take away one side of a plane; the cut of a closed mesh is closed</source>
        <translation>Quitar un lado de un plano; el corte de una malla cerrada se cierra</translation>
    </message>
    <message>
        <source>Cut off what is not shown</source>
        <translation>Cortar lo que no se muestra</translation>
    </message>
    <message>
        <source>Choose a mesh or cloud above</source>
        <translation>Elija arriba una malla o una nube</translation>
    </message>
    <message>
        <source>Nothing selected</source>
        <translation>Nada seleccionado</translation>
    </message>
    <message>
        <source>%1 of %2 triangles selected</source>
        <translation>%1 de %2 triángulos seleccionados</translation>
    </message>
    <message>
        <source>%1 of %2 points selected</source>
        <translation>%1 de %2 puntos seleccionados</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 de %2</translation>
    </message>
    <message>
        <source>%1 closed</source>
        <translation>%1 cerrados</translation>
    </message>
    <message>
        <source>waves below %1 mm</source>
        <translation>ondas por debajo de %1 mm</translation>
    </message>
    <message>
        <source>Reduce</source>
        <translation>Reducir</translation>
    </message>
    <message>
        <source>%1 triangles, before %2</source>
        <translation>%1 triángulos, antes %2</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Cortar</translation>
    </message>
    <message>
        <source>one side of the plane is left</source>
        <translation>queda un lado del plano</translation>
    </message>
    <message>
        <source>closed by a face of %1 cm²</source>
        <translation>cerrado con una cara de %1 cm²</translation>
    </message>
    <message>
        <source>the cut is open, as the mesh was not closed</source>
        <translation>el corte está abierto, porque la malla no estaba cerrada</translation>
    </message>
    <message>
        <source>select</source>
        <translation>seleccionar</translation>
    </message>
    <message>
        <source>%1; its texture does not fit any more</source>
        <translation>%1; su textura ya no encaja</translation>
    </message>
    <message>
        <source>Small pieces</source>
        <translation>Trozos pequeños</translation>
    </message>
    <message>
        <source>Select every separate piece below a twentieth of the largest one</source>
        <translation>Seleccionar todo trozo que no está unido a nada grande: por debajo de una veinteava parte del mayor</translation>
    </message>
    <message numerus="yes">
        <source>%n small piece(s) selected</source>
        <translation>
            <numerusform>%n trozo pequeño seleccionado</numerusform>
            <numerusform>%n trozos pequeños seleccionados</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>; %n small piece(s) left, see Small pieces</source>
        <translation>
            <numerusform>; queda %n trozo pequeño, véase Trozos pequeños</numerusform>
            <numerusform>; quedan %n trozos pequeños, véase Trozos pequeños</numerusform>
        </translation>
    </message>
    <message>
        <source>%1 is hidden: show it in the list first</source>
        <translation>%1 está oculto: muéstrelo primero en la lista</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ExplorerMode</name>
    <message>
        <source>Compare</source>
        <translation>Comparar</translation>
    </message>
    <message>
        <source>Another side</source>
        <translation>Otro lado</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Veredicto</translation>
    </message>
    <message>
        <source>Nothing loaded yet</source>
        <translation>Aún no hay nada cargado</translation>
    </message>
    <message>
        <source>Drop meshes, point clouds or recordings here, or begin with a scan.</source>
        <translation>Suelte aquí mallas, nubes de puntos o grabaciones, o empiece con un escaneo.</translation>
    </message>
    <message>
        <source>Open…</source>
        <translation>Abrir…</translation>
    </message>
    <message>
        <source>Scan an object</source>
        <translation>Escanear un objeto</translation>
    </message>
    <message>
        <source>Simulate a scan</source>
        <translation>Simular un escaneo</translation>
    </message>
    <message>
        <source>Open meshes, clouds or recordings</source>
        <translation>Abrir mallas, nubes o grabaciones</translation>
    </message>
    <message>
        <source>Meshes, clouds and recordings (*.ply *.pcd *.stl *.obj *.off *.3mf *.glb *.dae *.fbx recording.json *.bag *.mcap *.db3 *.mkv *.r3d *.sens *.conf *.json);;All files (*)</source>
        <translation>Mallas, nubes y grabaciones (*.ply *.pcd *.stl *.obj *.off *.3mf *.glb *.dae *.fbx recording.json *.bag *.mcap *.db3 *.mkv *.r3d *.sens *.conf *.json);;Todos los archivos (*)</translation>
    </message>
    <message>
        <source>Save %1</source>
        <translation>Guardar %1</translation>
    </message>
    <message>
        <source>PLY (*.ply);;STL, millimetres (*.stl);;3MF, millimetres (*.3mf);;OBJ (*.obj);;GLB (*.glb)</source>
        <translation>PLY (*.ply);;STL, milímetros (*.stl);;3MF, milímetros (*.3mf);;OBJ (*.obj);;GLB (*.glb)</translation>
    </message>
    <message>
        <source>PLY (*.ply)</source>
        <translation>PLY (*.ply)</translation>
    </message>
    <message>
        <source>Export the report of %1</source>
        <translation>Exportar el informe de %1</translation>
    </message>
    <message>
        <source>Report page (*.html)</source>
        <translation>Página de informe (*.html)</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>Abrir %1</translation>
    </message>
    <message>
        <source>open %1</source>
        <translation>abrir %1</translation>
    </message>
    <message>
        <source>reconstruct</source>
        <translation>reconstruir</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filtrar</translation>
    </message>
    <message>
        <source>%1 filtered</source>
        <translation>%1 filtrado</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 respecto a %2</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Se escribió %1</translation>
    </message>
    <message>
        <source>Colour the mesh</source>
        <translation>Colorear la malla</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>Exportar %1</translation>
    </message>
    <message>
        <source>; without the 3D view, which this build lacks</source>
        <translation>; sin la vista 3D, que falta en esta compilación</translation>
    </message>
    <message>
        <source>Wrote %1%2</source>
        <translation>Se escribió %1%2</translation>
    </message>
    <message>
        <source>Restore the session</source>
        <translation>Restaurar la sesión</translation>
    </message>
    <message>
        <source>restore the session</source>
        <translation>restaurar la sesión</translation>
    </message>
    <message>
        <source>These could not be restored, and are kept in %1: %2</source>
        <translation>Estos no se pudieron restaurar y se conservan en %1: %2</translation>
    </message>
    <message>
        <source>Save preset</source>
        <translation>Guardar ajustes</translation>
    </message>
    <message>
        <source>Select a mesh or a cloud to export</source>
        <translation>Seleccione una malla o una nube para exportar</translation>
    </message>
    <message>
        <source>Pictures, NAME-0001.png and so on (*.png)</source>
        <translation>Imágenes, NOMBRE-0001.png, etc. (*.png)</translation>
    </message>
    <message>
        <source>Turntable movie</source>
        <translation>Película giratoria</translation>
    </message>
    <message>
        <source>Film (*.mp4)</source>
        <translation>Película (*.mp4)</translation>
    </message>
    <message>
        <source>Reconstruct %1</source>
        <translation>Reconstruir %1</translation>
    </message>
    <message>
        <source>reconstruct %1</source>
        <translation>reconstruir %1</translation>
    </message>
    <message>
        <source>Deviations</source>
        <translation>Desviaciones</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Medir</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>Sección</translation>
    </message>
    <message>
        <source>Editing</source>
        <translation>Edición</translation>
    </message>
    <message>
        <source>History</source>
        <translation>Historial</translation>
    </message>
    <message>
        <source>filter %1</source>
        <translation>filtrar %1</translation>
    </message>
    <message>
        <source>distances</source>
        <translation>distancias</translation>
    </message>
    <message>
        <source>Join by points</source>
        <translation>Unir por puntos</translation>
    </message>
    <message>
        <source>%1
Another side, Join by points shows how it lay.</source>
        <translation>%1
Otro lado, Unir por puntos muestra cómo estaba.</translation>
    </message>
    <message>
        <source>Voxels</source>
        <translation>Vóxeles</translation>
    </message>
    <message>
        <source>Stages</source>
        <translation>Etapas</translation>
    </message>
    <message>
        <source>Voxelise keeps voxels with %1 points or more from now on</source>
        <translation>Desde ahora, Voxelizar conserva los vóxeles con %1 puntos o más</translation>
    </message>
    <message>
        <source>%1 was not opened</source>
        <translation>%1 no se ha abierto</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Fotogramas</translation>
    </message>
    <message>
        <source>Inspect</source>
        <translation>Inspeccionar</translation>
    </message>
    <message>
        <source>Edit</source>
        <translation>Editar</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ver</translation>
    </message>
    <message>
        <source>Process</source>
        <translation>Procesar</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ExportDialog</name>
    <message>
        <source>Export %1</source>
        <translation>Exportar %1</translation>
    </message>
    <message>
        <source>PLY</source>
        <translation>PLY</translation>
    </message>
    <message>
        <source>STL, for printing</source>
        <translation>STL, para imprimir</translation>
    </message>
    <message>
        <source>3MF, for printing, with colours</source>
        <translation>3MF, para imprimir, con colores</translation>
    </message>
    <message>
        <source>OBJ</source>
        <translation>OBJ</translation>
    </message>
    <message>
        <source>GLB, for the web</source>
        <translation>GLB, para la web</translation>
    </message>
    <message>
        <source>Millimetres</source>
        <translation>Milímetros</translation>
    </message>
    <message>
        <source>Centimetres</source>
        <translation>Centímetros</translation>
    </message>
    <message>
        <source>Inches</source>
        <translation>Pulgadas</translation>
    </message>
    <message>
        <source>Metres</source>
        <translation>Metros</translation>
    </message>
    <message>
        <source>Usual for the format: Z in STL and 3MF, else Y</source>
        <translation>La habitual del formato: Z en STL y 3MF; si no, Y</translation>
    </message>
    <message>
        <source>Y, as in the view</source>
        <translation>Y, como en la vista</translation>
    </message>
    <message>
        <source>Z, as slicers and CAD have it</source>
        <translation>Z, como en laminadores y CAD</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Textura</translation>
    </message>
    <message>
        <source>Colours of the vertices</source>
        <translation>Colores de los vértices</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Ninguno</translation>
    </message>
    <message>
        <source>all %1</source>
        <translation>los %1</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>Formato</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Unidad</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Hacia arriba</translation>
    </message>
    <message>
        <source>Triangles, at most</source>
        <translation>Triángulos, como máximo</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>Colores</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exportar…</translation>
    </message>
    <message>
        <source>The format says its unit: %1.</source>
        <translation>El formato indica su unidad: %1.</translation>
    </message>
    <message>
        <source>GLB is always Y up.</source>
        <translation>En GLB, Y siempre va hacia arriba.</translation>
    </message>
    <message>
        <source>With fewer triangles the texture becomes colours of the vertices.</source>
        <translation>Con menos triángulos la textura pasa a ser colores de los vértices.</translation>
    </message>
    <message>
        <source>This format keeps no texture.</source>
        <translation>Este formato no conserva texturas.</translation>
    </message>
    <message>
        <source>STL keeps no colours.</source>
        <translation>STL no conserva colores.</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::FramePanel</name>
    <message>
        <source>Frame of the recording</source>
        <translation>Fotograma de la grabación</translation>
    </message>
    <message>
        <source>Arrow keys step from frame to frame; frames left out are marked</source>
        <translation>Las flechas pasan de un fotograma a otro; los que se omitieron están marcados</translation>
    </message>
    <message>
        <source>Depth image</source>
        <translation>Imagen de profundidad</translation>
    </message>
    <message>
        <source>Colour image</source>
        <translation>Imagen en color</translation>
    </message>
    <message>
        <source>Frame %1 of %2</source>
        <translation>Fotograma %1 de %2</translation>
    </message>
    <message>
        <source>sensor %1</source>
        <translation>sensor %1</translation>
    </message>
    <message>
        <source>pass %1</source>
        <translation>pasada %1</translation>
    </message>
    <message>
        <source>lost while it was recorded</source>
        <translation>se perdió al grabar</translation>
    </message>
    <message>
        <source>left out of the mesh, because its pose is not known</source>
        <translation>no está en la malla, porque no se conoce su pose</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Fotograma</translation>
    </message>
    <message>
        <source>Yellow is %1 m from the sensor, violet %2 m</source>
        <translation>Lo amarillo está a %1 m del sensor, lo violeta a %2 m</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::HistoryPanel</name>
    <message>
        <source>History</source>
        <translation>Historial</translation>
    </message>
    <message>
        <source>A click goes back to that state, or forward again</source>
        <translation>Un clic vuelve a ese estado, o avanza de nuevo</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Inicio</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::JobBar</name>
    <message>
        <source>Cancel</source>
        <translation>Cancelar</translation>
    </message>
    <message>
        <source>Stop the running job (Esc)</source>
        <translation>Detener la tarea en curso (Esc)</translation>
    </message>
    <message>
        <source>Progress of the running job</source>
        <translation>Progreso de la tarea en curso</translation>
    </message>
    <message>
        <source>%1 s so far</source>
        <translation>%1 s hasta ahora</translation>
    </message>
    <message>
        <source>%1 more</source>
        <translation>%1 más</translation>
    </message>
    <message>
        <source>Next:</source>
        <translation>Después:</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::JoinPanel</name>
    <message>
        <source>Mesh so far</source>
        <translation>Malla hasta ahora</translation>
    </message>
    <message>
        <source>New pass</source>
        <translation>Pasada nueva</translation>
    </message>
    <message>
        <source>Pick pairs</source>
        <translation>Marcar pares</translation>
    </message>
    <message>
        <source>Click at least three places, each on both meshes</source>
        <translation>Haga clic en al menos tres lugares, cada uno en ambas mallas</translation>
    </message>
    <message>
        <source>Undo click</source>
        <translation>Deshacer clic</translation>
    </message>
    <message>
        <source>Take the last click back</source>
        <translation>Retirar el último clic</translation>
    </message>
    <message>
        <source>Join</source>
        <translation>Unir</translation>
    </message>
    <message>
        <source>Bring the new pass there, refine its place by the surfaces, and make one mesh of all passes; refused where the surfaces contradict it</source>
        <translation>Llevar allí la pasada nueva, afinar su lugar con las superficies y hacer una malla de todas las pasadas; se rechaza si las superficies lo contradicen</translation>
    </message>
    <message>
        <source>Each pass by itself</source>
        <translation>Cada pasada por separado</translation>
    </message>
    <message>
        <source>Make a mesh of each pass of the selected joined one, to join them anew</source>
        <translation>Hacer una malla de cada pasada de la malla unida seleccionada, para unirlas de nuevo</translation>
    </message>
    <message>
        <source>Where a pass was not joined, or wrongly, pairs of places on both meshes say how it lay.</source>
        <translation>Si una pasada no se unió, o se unió mal, pares de lugares en ambas mallas dicen cómo estaba.</translation>
    </message>
    <message>
        <source>Choose meshes of different passes of one recording.</source>
        <translation>Elija mallas de pasadas distintas de una grabación.</translation>
    </message>
    <message>
        <source>Pair %1: click the same place on both.</source>
        <translation>Par %1: haga clic en el mismo lugar de ambas.</translation>
    </message>
    <message>
        <source>Pair %1: click it on the right, too.</source>
        <translation>Par %1: haga clic en él también a la derecha.</translation>
    </message>
    <message>
        <source>Pair %1: click it on the left, too.</source>
        <translation>Par %1: haga clic en él también a la izquierda.</translation>
    </message>
    <message>
        <source>%1 pairs, which fit within %2 mm (rms). Join, or click more.</source>
        <translation>%1 pares, que encajan con %2 mm (rms). Una, o marque más.</translation>
    </message>
    <message>
        <source>join by points</source>
        <translation>unir por puntos</translation>
    </message>
    <message>
        <source>%1 and %2 are one mesh now</source>
        <translation>%1 y %2 son ahora una sola malla</translation>
    </message>
    <message>
        <source>passes by themselves</source>
        <translation>pasadas por separado</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::LookPanel</name>
    <message>
        <source>Opacity of the selected model</source>
        <translation>Opacidad del modelo seleccionado</translation>
    </message>
    <message>
        <source>Isolate</source>
        <translation>Aislar</translation>
    </message>
    <message>
        <source>Show the selected model alone</source>
        <translation>Mostrar solo el modelo seleccionado</translation>
    </message>
    <message>
        <source>Turntable movie…</source>
        <translation>Película…</translation>
    </message>
    <message>
        <source>A film or pictures of the view, turned once about the vertical</source>
        <translation>Una película o imágenes de la vista, que da una vuelta sobre la vertical</translation>
    </message>
    <message>
        <source>Ambient occlusion</source>
        <translation>Oclusión ambiental</translation>
    </message>
    <message>
        <source>Shaded</source>
        <translation>Sombreado</translation>
    </message>
    <message>
        <source>Shaded, with edges</source>
        <translation>Sombreado, con aristas</translation>
    </message>
    <message>
        <source>Wireframe</source>
        <translation>Alambre</translation>
    </message>
    <message>
        <source>Normals</source>
        <translation>Normales</translation>
    </message>
    <message>
        <source>How surfaces are drawn; normals: x red, y green, z blue</source>
        <translation>Cómo se dibujan las superficies; normales: x rojo, y verde, z azul</translation>
    </message>
    <message>
        <source>Draw recesses darker (ambient occlusion) while the view does not move; slow without a graphics card</source>
        <translation>Los lugares a los que llega poca luz son más oscuros mientras la vista no se mueve; lento sin tarjeta gráfica</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>Superficie</translation>
    </message>
    <message>
        <source>Opacity</source>
        <translation>Opacidad</translation>
    </message>
    <message>
        <source>Clip</source>
        <translation>Seccionar</translation>
    </message>
    <message>
        <source>Axis of the clipping plane</source>
        <translation>Eje del plano de sección</translation>
    </message>
    <message>
        <source>Off</source>
        <translation>No</translation>
    </message>
    <message>
        <source>Place of the clipping plane</source>
        <translation>Posición del plano de sección</translation>
    </message>
    <message>
        <source>Flip</source>
        <translation>Invertir</translation>
    </message>
    <message>
        <source>Show the other side</source>
        <translation>Mostrar el otro lado</translation>
    </message>
    <message>
        <source>Show the other side of the clipping plane</source>
        <translation>Mostrar el otro lado del plano de sección</translation>
    </message>
    <message>
        <source>Stages…</source>
        <translation>Etapas…</translation>
    </message>
    <message>
        <source>What is checked in the list, side by side in one picture</source>
        <translation>Lo que está marcado en la lista, lado a lado en una imagen</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MainWindow</name>
    <message>
        <source>Left button</source>
        <translation>Botón izquierdo</translation>
    </message>
    <message>
        <source>turn</source>
        <translation>girar</translation>
    </message>
    <message>
        <source>Middle button, or Shift and left</source>
        <translation>Botón central, o Mayús e izquierdo</translation>
    </message>
    <message>
        <source>move</source>
        <translation>desplazar</translation>
    </message>
    <message>
        <source>Wheel, or right button</source>
        <translation>Rueda, o botón derecho</translation>
    </message>
    <message>
        <source>nearer, farther</source>
        <translation>acercar, alejar</translation>
    </message>
    <message>
        <source>Arrows, +, -</source>
        <translation>Flechas, +, -</translation>
    </message>
    <message>
        <source>turn, nearer, farther</source>
        <translation>girar, acercar, alejar</translation>
    </message>
    <message>
        <source>Keyboard shortcuts</source>
        <translation>Atajos de teclado</translation>
    </message>
    <message>
        <source>The manual is not installed here</source>
        <translation>El manual no está instalado aquí</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Manual</translation>
    </message>
    <message>
        <source>Messages, oldest first</source>
        <translation>Mensajes, del más antiguo al más reciente</translation>
    </message>
    <message>
        <source>Messages</source>
        <translation>Mensajes</translation>
    </message>
    <message>
        <source>From an object on a turntable to a watertight mesh.</source>
        <translation>De un objeto sobre una mesa giratoria a una malla cerrada.</translation>
    </message>
    <message>
        <source>turnscan is free software under the Apache License 2.0, whose text is below.</source>
        <translation>turnscan es software libre con licencia Apache 2.0, cuyo texto está más abajo.</translation>
    </message>
    <message>
        <source>It uses these libraries, with Qt %1 and VTK %2:</source>
        <translation>Usa estas bibliotecas, con Qt %1 y VTK %2:</translation>
    </message>
    <message>
        <source>About turnscan Studio</source>
        <translation>Acerca de turnscan Studio</translation>
    </message>
    <message>
        <source>Open a recording</source>
        <translation>Abrir una grabación</translation>
    </message>
    <message>
        <source>Save screenshot</source>
        <translation>Guardar captura</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Imágenes (*.png)</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Archivo</translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation>A&amp;brir…</translation>
    </message>
    <message>
        <source>Open &amp;recording…</source>
        <translation>Abrir &amp;grabación…</translation>
    </message>
    <message>
        <source>Open r&amp;ecent</source>
        <translation>Abrir &amp;reciente</translation>
    </message>
    <message>
        <source>&amp;Save…</source>
        <translation>&amp;Guardar…</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation>&amp;Exportar…</translation>
    </message>
    <message>
        <source>Reconstruct se&amp;veral recordings…</source>
        <translation>Reconstruir &amp;varias grabaciones…</translation>
    </message>
    <message>
        <source>Save s&amp;creenshot…</source>
        <translation>Guardar &amp;captura…</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Salir</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Editar</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Rehacer</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Eliminar</translation>
    </message>
    <message>
        <source>Cancel the running job</source>
        <translation>Cancelar la tarea en curso</translation>
    </message>
    <message>
        <source>&amp;Language</source>
        <translation>&amp;Idioma</translation>
    </message>
    <message>
        <source>The language changes with the next start</source>
        <translation>El idioma cambia en el próximo inicio</translation>
    </message>
    <message>
        <source>As the system</source>
        <translation>El del sistema</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ver</translation>
    </message>
    <message>
        <source>Reset camera</source>
        <translation>Encuadrar todo</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Frente</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Atrás</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Izquierda</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Derecha</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>Arriba</translation>
    </message>
    <message>
        <source>Bottom</source>
        <translation>Abajo</translation>
    </message>
    <message>
        <source>Corner</source>
        <translation>Esquina</translation>
    </message>
    <message>
        <source>Bounding boxes</source>
        <translation>Cajas</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Oscuro</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>A&amp;yuda</translation>
    </message>
    <message>
        <source>&amp;Manual</source>
        <translation>&amp;Manual</translation>
    </message>
    <message>
        <source>&amp;Keyboard shortcuts</source>
        <translation>A&amp;tajos de teclado</translation>
    </message>
    <message>
        <source>&amp;About turnscan Studio</source>
        <translation>&amp;Acerca de turnscan Studio</translation>
    </message>
    <message>
        <source>turnscan Studio</source>
        <translation>turnscan Studio</translation>
    </message>
    <message>
        <source>3D Scanner</source>
        <translation>Escáner 3D</translation>
    </message>
    <message>
        <source>Calibrate and record with a sensor (F1)</source>
        <translation>Calibrar y grabar con un sensor (F1)</translation>
    </message>
    <message>
        <source>Model Explorer</source>
        <translation>Explorador de modelos</translation>
    </message>
    <message>
        <source>Look at models and process them (F2)</source>
        <translation>Ver modelos y procesarlos (F2)</translation>
    </message>
    <message>
        <source>Scanner Simulator</source>
        <translation>Simulador de escáneres</translation>
    </message>
    <message>
        <source>Try a rig before it is built (F3)</source>
        <translation>Probar un montaje antes de construirlo (F3)</translation>
    </message>
    <message>
        <source>%1: cancelled</source>
        <translation>%1: cancelado</translation>
    </message>
    <message>
        <source>%1: failed</source>
        <translation>%1: ha fallado</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Se escribió %1</translation>
    </message>
    <message>
        <source>No files yet</source>
        <translation>Aún no hay archivos</translation>
    </message>
    <message>
        <source>Undo %1</source>
        <translation>Deshacer %1</translation>
    </message>
    <message>
        <source>Redo %1</source>
        <translation>Rehacer %1</translation>
    </message>
    <message>
        <source>A recording runs; it ends, and what it has is kept</source>
        <translation>Hay una grabación en curso; termina y se conserva lo grabado</translation>
    </message>
    <message>
        <source>Go on with the recording?</source>
        <translation>¿Continuar la grabación?</translation>
    </message>
    <message numerus="yes">
        <source>The last session ended while it recorded. %1 has %n frame(s).</source>
        <translation>
            <numerusform>La última sesión terminó mientras grababa. %1 tiene %n imagen.</numerusform>
            <numerusform>La última sesión terminó mientras grababa. %1 tiene %n imágenes.</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Continuar</translation>
    </message>
    <message>
        <source>Leave it</source>
        <translation>Dejarla</translation>
    </message>
    <message>
        <source>Restore the last session?</source>
        <translation>¿Restaurar la última sesión?</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Restaurar</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Descartar</translation>
    </message>
    <message>
        <source>Ask again later</source>
        <translation>Preguntar más tarde</translation>
    </message>
    <message>
        <source>All models are in files</source>
        <translation>Todos los modelos están en archivos</translation>
    </message>
    <message>
        <source>Folder for all models</source>
        <translation>Carpeta para todos los modelos</translation>
    </message>
    <message>
        <source>Save &amp;all…</source>
        <translation>Guardar &amp;todo…</translation>
    </message>
    <message numerus="yes">
        <source>%n model(s) cannot be kept for the next start and are in no file: %1</source>
        <translation>
            <numerusform>%n modelo no puede conservarse para el próximo inicio y no está en ningún archivo: %1</numerusform>
            <numerusform>%n modelos no pueden conservarse para el próximo inicio y no están en ningún archivo: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>The last session had these models:
%1</source>
        <translation>La última sesión tenía estos modelos:
%1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MeasurePanel</name>
    <message>
        <source>A plane is fitted to the surface within this distance of the click</source>
        <translation>Se ajusta un plano a la superficie dentro de esta distancia del clic</translation>
    </message>
    <message>
        <source>Radius of the patch that a plane is fitted to</source>
        <translation>Radio de la zona a la que se ajusta un plano</translation>
    </message>
    <message>
        <source>Plane within</source>
        <translation>Plano dentro de</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Mediciones</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Quitar</translation>
    </message>
    <message>
        <source>Remove the chosen measurement</source>
        <translation>Quitar la medición elegida</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>Vaciar</translation>
    </message>
    <message>
        <source>Remove all measurements</source>
        <translation>Quitar todas las mediciones</translation>
    </message>
    <message>
        <source>Export CSV…</source>
        <translation>Exportar CSV…</translation>
    </message>
    <message>
        <source>All measurements as a table</source>
        <translation>Todas las mediciones como tabla</translation>
    </message>
    <message>
        <source>Place %1 of %2</source>
        <translation>Lugar %1 de %2</translation>
    </message>
    <message>
        <source>Export measurements</source>
        <translation>Exportar las mediciones</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>Tabla (*.csv)</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>Exportar %1</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Se escribió %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MessageLog</name>
    <message>
        <source>Error: </source>
        <translation>Error: </translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ModelList</name>
    <message>
        <source>Properties of the selected model</source>
        <translation>Propiedades del modelo seleccionado</translation>
    </message>
    <message>
        <source>Open…</source>
        <translation>Abrir…</translation>
    </message>
    <message>
        <source>Load meshes, clouds or recordings (Ctrl+O)</source>
        <translation>Cargar mallas, nubes o grabaciones (Ctrl+O)</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Guardar…</translation>
    </message>
    <message>
        <source>Save the selected model (Ctrl+S)</source>
        <translation>Guardar el modelo seleccionado (Ctrl+S)</translation>
    </message>
    <message>
        <source>Edit</source>
        <translation>Editar</translation>
    </message>
    <message>
        <source>Rename, colour, duplicate, delete</source>
        <translation>Renombrar, color, duplicar, eliminar</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Renombrar</translation>
    </message>
    <message>
        <source>Colour…</source>
        <translation>Color…</translation>
    </message>
    <message>
        <source>Own colours on/off</source>
        <translation>Colores propios sí/no</translation>
    </message>
    <message>
        <source>Duplicate</source>
        <translation>Duplicar</translation>
    </message>
    <message>
        <source>Delete	Del</source>
        <translation>Eliminar	Supr</translation>
    </message>
    <message>
        <source>Colour of %1</source>
        <translation>Color de %1</translation>
    </message>
    <message>
        <source>Models</source>
        <translation>Modelos</translation>
    </message>
    <message>
        <source>Use its settings</source>
        <translation>Usar sus ajustes</translation>
    </message>
    <message>
        <source>Not made with the defaults:
%1</source>
        <translation>No se hizo con los valores por defecto:
%1</translation>
    </message>
    <message>
        <source>Pass %1</source>
        <translation>Pasada %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ModelStore</name>
    <message>
        <source>add %1</source>
        <translation>añadir %1</translation>
    </message>
    <message>
        <source>rename</source>
        <translation>renombrar</translation>
    </message>
    <message>
        <source>show</source>
        <translation>mostrar</translation>
    </message>
    <message>
        <source>hide</source>
        <translation>ocultar</translation>
    </message>
    <message>
        <source>colour</source>
        <translation>color</translation>
    </message>
    <message>
        <source>opacity of %1</source>
        <translation>opacidad de %1</translation>
    </message>
    <message>
        <source>duplicate</source>
        <translation>duplicar</translation>
    </message>
    <message>
        <source>delete</source>
        <translation>eliminar</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::MotorPanel</name>
    <message>
        <source>Serial port of the board that turns the table, e.g. /dev/ttyUSB0</source>
        <translation>Puerto serie de la placa que gira la mesa, p. ej. /dev/ttyUSB0</translation>
    </message>
    <message>
        <source>Turn</source>
        <translation>Girar</translation>
    </message>
    <message>
        <source>Turn the table to see that it works: 10 degrees a second</source>
        <translation>Girar la mesa para ver que funciona: 10 grados por segundo</translation>
    </message>
    <message>
        <source>With a motor, Record turns the table by itself.</source>
        <translation>Con un motor, Grabar hace girar la mesa.</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>Placa</translation>
    </message>
    <message>
        <source>No motor</source>
        <translation>Sin motor</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Detener</translation>
    </message>
    <message>
        <source>Turning</source>
        <translation>Girando</translation>
    </message>
    <message>
        <source>The table stands at %1 degrees</source>
        <translation>La mesa está a %1 grados</translation>
    </message>
    <message>
        <source>The table does not turn</source>
        <translation>La mesa no gira</translation>
    </message>
    <message>
        <source>Port of the motor</source>
        <translation>Puerto del motor</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::OptionForm</name>
    <message>
        <source>automatic</source>
        <translation>automático</translation>
    </message>
    <message>
        <source>auto: %1</source>
        <translation>auto: %1</translation>
    </message>
    <message>
        <source>&lt;br&gt;&lt;i&gt;Last run: %1, %2&lt;/i&gt;</source>
        <translation>&lt;br&gt;&lt;i&gt;Última vez: %1, %2&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;br&gt;&lt;i&gt;Not the default, %1: click to reset&lt;/i&gt;</source>
        <translation>&lt;br&gt;&lt;i&gt;No es el valor predeterminado, %1: haga clic para restablecerlo&lt;/i&gt;</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::PlaneBox</name>
    <message>
        <source>Flip</source>
        <translation>Invertir</translation>
    </message>
    <message>
        <source>Keep the other side</source>
        <translation>Conservar el otro lado</translation>
    </message>
    <message>
        <source>The axis that the plane is perpendicular to</source>
        <translation>El eje al que el plano es perpendicular</translation>
    </message>
    <message>
        <source>Axis of the plane</source>
        <translation>Eje del plano</translation>
    </message>
    <message>
        <source>Where the plane meets the axis</source>
        <translation>Dónde corta el plano al eje</translation>
    </message>
    <message>
        <source>Place of the plane</source>
        <translation>Lugar del plano</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::QueueDialog</name>
    <message>
        <source>Reconstruct several recordings</source>
        <translation>Reconstruir varias grabaciones</translation>
    </message>
    <message>
        <source>They are reconstructed one after the other with the options of the Model Explorer. Add recordings, or drop them here.</source>
        <translation>Se reconstruyen una tras otra con las opciones del Explorador de modelos. Añada grabaciones o suéltelas aquí.</translation>
    </message>
    <message>
        <source>Recordings in the queue</source>
        <translation>Grabaciones en la cola</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Grabación</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Estado</translation>
    </message>
    <message>
        <source>Write meshes to</source>
        <translation>Escribir las mallas en</translation>
    </message>
    <message>
        <source>nowhere: they are in the Model Explorer only</source>
        <translation>ninguna parte: quedan solo en el Explorador de modelos</translation>
    </message>
    <message>
        <source>running</source>
        <translation>en curso</translation>
    </message>
    <message>
        <source>cancelled</source>
        <translation>cancelada</translation>
    </message>
    <message>
        <source>Add recording…</source>
        <translation>Añadir grabación…</translation>
    </message>
    <message>
        <source>The folder of a recording</source>
        <translation>La carpeta de una grabación</translation>
    </message>
    <message>
        <source>Add files…</source>
        <translation>Añadir archivos…</translation>
    </message>
    <message>
        <source>Recordings of other programs</source>
        <translation>Grabaciones de otros programas</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Quitar</translation>
    </message>
    <message>
        <source>Take the selected ones off the list</source>
        <translation>Quitar de la lista las seleccionadas</translation>
    </message>
    <message>
        <source>Reconstruct all</source>
        <translation>Reconstruir todo</translation>
    </message>
    <message>
        <source>Begin with the first that waits</source>
        <translation>Empezar por la primera en espera</translation>
    </message>
    <message>
        <source>Add a recording</source>
        <translation>Añadir una grabación</translation>
    </message>
    <message>
        <source>Add recordings</source>
        <translation>Añadir grabaciones</translation>
    </message>
    <message>
        <source>waits</source>
        <translation>en espera</translation>
    </message>
    <message>
        <source>queued</source>
        <translation>en cola</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::RecordPanel</name>
    <message>
        <source>Folder to make; a number is added where it has content</source>
        <translation>Carpeta que se crea; se le añade un número si tiene contenido</translation>
    </message>
    <message>
        <source>…</source>
        <translation>…</translation>
    </message>
    <message>
        <source>Choose the folder</source>
        <translation>Elegir la carpeta</translation>
    </message>
    <message>
        <source>Make the mesh when it is done</source>
        <translation>Hacer la malla al terminar</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Grabar</translation>
    </message>
    <message>
        <source>Folder of the recording</source>
        <translation>Carpeta de la grabación</translation>
    </message>
    <message>
        <source>The recording in %1 was ended early. It goes on with the same device and the same options.</source>
        <translation>La grabación en %1 terminó antes de tiempo. Continúa con el mismo dispositivo y las mismas opciones.</translation>
    </message>
    <message>
        <source>Go on with the recording</source>
        <translation>Continuar la grabación</translation>
    </message>
    <message>
        <source>New recording instead</source>
        <translation>Mejor una grabación nueva</translation>
    </message>
    <message>
        <source>What is recorded next is another object, or this one anew</source>
        <translation>Lo siguiente que se graba es otro objeto, o este de nuevo</translation>
    </message>
    <message>
        <source>The next pass goes into %1. %2</source>
        <translation>La próxima pasada va a %1. %2</translation>
    </message>
    <message>
        <source>Motor</source>
        <translation>Motor</translation>
    </message>
    <message>
        <source>More options</source>
        <translation>Más opciones</translation>
    </message>
    <message>
        <source>The motor is being tried; stop it first</source>
        <translation>Se está probando el motor; deténgalo primero</translation>
    </message>
    <message>
        <source>turn %1</source>
        <translation>vuelta %1</translation>
    </message>
    <message>
        <source>turns not known yet</source>
        <translation>vueltas aún desconocidas</translation>
    </message>
    <message>
        <source>, %1 GB free</source>
        <translation>, %1 GB libres</translation>
    </message>
    <message>
        <source>%1 frames, %2, %3 dropped%4</source>
        <translation>%1 fotogramas, %2, %3 perdidos%4</translation>
    </message>
    <message>
        <source>Seen so far: about %1 cm², %2 % of it well (from %3 sides or more)</source>
        <translation>Visto hasta ahora: unos %1 cm², el %2 % bien (desde %3 lados o más)</translation>
    </message>
    <message>
        <source>; %1 % of the surface is still missing</source>
        <translation>; aún falta el %1 % de la superficie</translation>
    </message>
    <message>
        <source>Stop recording</source>
        <translation>Detener la grabación</translation>
    </message>
    <message>
        <source>Record another side</source>
        <translation>Grabar otro lado</translation>
    </message>
    <message>
        <source>The surface is shown once the object&apos;s motion is known, seconds after it begins to turn.</source>
        <translation>La superficie aparece cuando se conoce el movimiento del objeto, segundos después de que empiece a girar.</translation>
    </message>
    <message>
        <source>Recorded %1</source>
        <translation>Grabado: %1</translation>
    </message>
    <message>
        <source>Progress of the recording</source>
        <translation>Progreso de la grabación</translation>
    </message>
    <message>
        <source>Record until the turns are done; Space records and stops</source>
        <translation>Grabar hasta completar las vueltas; la barra espaciadora graba y detiene</translation>
    </message>
    <message>
        <source>It has content: the next recording goes into %1</source>
        <translation>Tiene contenido: la próxima grabación va a %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ScannerEditor</name>
    <message>
        <source>What it is</source>
        <translation>Qué es</translation>
    </message>
    <message>
        <source>Where it stands</source>
        <translation>Dónde está</translation>
    </message>
    <message>
        <source>Its noise</source>
        <translation>Su ruido</translation>
    </message>
    <message>
        <source>Preset to fill the fields from</source>
        <translation>Modelo predefinido con el que rellenar los campos</translation>
    </message>
    <message>
        <source>Fill from…</source>
        <translation>Rellenar con…</translation>
    </message>
    <message>
        <source>Save as scanner…</source>
        <translation>Guardar como escáner…</translation>
    </message>
    <message>
        <source>These fields as a file for --scanner and for Add scanner</source>
        <translation>Estos campos como archivo para --scanner y para Añadir escáner</translation>
    </message>
    <message>
        <source>%1, changed</source>
        <translation>%1, modificado</translation>
    </message>
    <message>
        <source>Save as scanner</source>
        <translation>Guardar como escáner</translation>
    </message>
    <message>
        <source>Scanners (*.toml)</source>
        <translation>Escáneres (*.toml)</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ScannerMode</name>
    <message>
        <source>No picture yet</source>
        <translation>Aún no hay imagen</translation>
    </message>
    <message>
        <source>Choose a device on the right and press Play. The virtual sensors need no hardware.</source>
        <translation>Elija un dispositivo a la derecha y pulse Ver. Los sensores virtuales no necesitan equipo.</translation>
    </message>
    <message>
        <source>Play now</source>
        <translation>Ver ahora</translation>
    </message>
    <message>
        <source>1  Device</source>
        <translation>1  Dispositivo</translation>
    </message>
    <message>
        <source>A device of the list, or any URI, e.g. replay:FOLDER</source>
        <translation>Un dispositivo de la lista o cualquier URI, p. ej. replay:CARPETA</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Ver</translation>
    </message>
    <message>
        <source>Show what the sensor sees</source>
        <translation>Mostrar lo que ve el sensor</translation>
    </message>
    <message>
        <source>Filter points</source>
        <translation>Filtrar puntos</translation>
    </message>
    <message>
        <source>Show only what stands on the turntable; needs a calibration</source>
        <translation>Mostrar solo lo que está sobre la mesa giratoria; necesita una calibración</translation>
    </message>
    <message>
        <source>Back to live</source>
        <translation>Volver al directo</translation>
    </message>
    <message>
        <source>Show what the sensor sees now</source>
        <translation>Mostrar lo que el sensor ve ahora</translation>
    </message>
    <message>
        <source>Not playing</source>
        <translation>Parado</translation>
    </message>
    <message>
        <source>3  Recording</source>
        <translation>3  Grabación</translation>
    </message>
    <message>
        <source>Calibrate again</source>
        <translation>Calibrar de nuevo</translation>
    </message>
    <message>
        <source>Take an averaged scan of the empty table, then press Calibrate</source>
        <translation>Tome un escaneo promediado de la mesa vacía y pulse Calibrar</translation>
    </message>
    <message>
        <source>Use motion</source>
        <translation>Usar el movimiento</translation>
    </message>
    <message>
        <source>Forget the calibration: the object&apos;s motion shows where the table is</source>
        <translation>Olvidar la calibración: el movimiento del objeto muestra dónde está la mesa</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, doll</source>
        <translation>Kinect v2 virtual, muñeca</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, letter A on a desk</source>
        <translation>Kinect v2 virtual, letra A en un escritorio</translation>
    </message>
    <message>
        <source>Virtual Kinect v1, cylinder</source>
        <translation>Kinect v1 virtual, cilindro</translation>
    </message>
    <message>
        <source>Virtual Kinect v2, empty table on a desk</source>
        <translation>Kinect v2 virtual, mesa vacía en un escritorio</translation>
    </message>
    <message>
        <source>Look for devices</source>
        <translation>Buscar dispositivos</translation>
    </message>
    <message>
        <source>Stopping</source>
        <translation>Deteniendo</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Detener</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>Abriendo %1</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Se escribió %1</translation>
    </message>
    <message>
        <source>Averaging: %1 of %2 frames</source>
        <translation>Promediando: %1 de %2 fotogramas</translation>
    </message>
    <message>
        <source>click</source>
        <translation>clic</translation>
    </message>
    <message>
        <source>2  Calibration</source>
        <translation>2  Calibración</translation>
    </message>
    <message>
        <source>Averaged scan</source>
        <translation>Escaneo promediado</translation>
    </message>
    <message>
        <source>Average frames of what stands still</source>
        <translation>Promediar fotogramas de lo que está quieto</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Calibrar</translation>
    </message>
    <message>
        <source>Options</source>
        <translation>Opciones</translation>
    </message>
    <message>
        <source>Pick rim points</source>
        <translation>Marcar el borde</translation>
    </message>
    <message>
        <source>Click at least 3 points on the platter&apos;s rim</source>
        <translation>Haga clic en al menos 3 puntos del borde del plato</translation>
    </message>
    <message>
        <source>Undo click</source>
        <translation>Deshacer clic</translation>
    </message>
    <message>
        <source>Take back the last point (Ctrl+Z)</source>
        <translation>Quitar el último punto (Ctrl+Z)</translation>
    </message>
    <message>
        <source>Load…</source>
        <translation>Cargar…</translation>
    </message>
    <message>
        <source>A calibration saved before</source>
        <translation>Una calibración guardada antes</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Guardar…</translation>
    </message>
    <message>
        <source>Keep the calibration as a file</source>
        <translation>Conservar la calibración en un archivo</translation>
    </message>
    <message>
        <source>Calibrations (*.json)</source>
        <translation>Calibraciones (*.json)</translation>
    </message>
    <message>
        <source>Load calibration</source>
        <translation>Cargar calibración</translation>
    </message>
    <message>
        <source>Save calibration</source>
        <translation>Guardar calibración</translation>
    </message>
    <message>
        <source>Averaged %1 frames; noise of one frame %2</source>
        <translation>%1 fotogramas promediados; ruido de un fotograma %2</translation>
    </message>
    <message>
        <source>%1. Pick points on the platter&apos;s rim instead.</source>
        <translation>%1. Marque mejor puntos en el borde del plato.</translation>
    </message>
    <message>
        <source>Click points on the rim of the platter, at least 3</source>
        <translation>Haga clic en puntos del borde del plato, al menos 3</translation>
    </message>
    <message>
        <source>%1 of at least 3 points</source>
        <translation>%1 de al menos 3 puntos</translation>
    </message>
    <message>
        <source>By %1: radius %2, error %3 (root mean square)</source>
        <translation>Por %1: radio %2, error %3 (media cuadrática)</translation>
    </message>
    <message>
        <source>
From the last recording with this device. Calibrate anew if sensor or table were moved since.</source>
        <translation>
De la última grabación con este dispositivo. Calibre de nuevo si desde entonces se movió el sensor o la mesa.</translation>
    </message>
    <message>
        <source>The calibration of the last recording is not used: %1</source>
        <translation>No se usa la calibración de la última grabación: %1</translation>
    </message>
    <message>
        <source>There is no calibration yet</source>
        <translation>Aún no hay calibración</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>Dispositivo</translation>
    </message>
    <message>
        <source>Waiting for the first picture</source>
        <translation>Esperando la primera imagen</translation>
    </message>
    <message>
        <source>The device says itself where its table stands.</source>
        <translation>El propio dispositivo dice dónde está su mesa.</translation>
    </message>
    <message>
        <source>%1 frames a second, %2 points</source>
        <translation>%1 fotogramas por segundo, %2 puntos</translation>
    </message>
    <message>
        <source>Find the turntable in an averaged scan, which is taken if there is none</source>
        <translation>Buscar la mesa giratoria en un escaneo promediado, que se toma si no hay ninguno</translation>
    </message>
    <message>
        <source>Correct</source>
        <translation>Corregir</translation>
    </message>
    <message>
        <source>The points are %1 off a circle (root mean square); %2 is the limit. Undo those that are not on the rim</source>
        <translation>Los puntos distan %1 de un círculo (media cuadrática); el límite es %2. Deshaga los que no estén en el borde</translation>
    </message>
    <message>
        <source>Platter: radius %1, known to %2</source>
        <translation>Plato: radio %1, conocido con %2</translation>
    </message>
    <message>
        <source>Platter: radius %1, how well is not known</source>
        <translation>Plato: radio %1, con precisión desconocida</translation>
    </message>
    <message>
        <source>The platter is not where the calibration has it</source>
        <translation>El plato no está donde dice la calibración</translation>
    </message>
    <message>
        <source>No platter is seen; the object&apos;s motion will show where the table is</source>
        <translation>No se ve ningún plato; el movimiento del objeto mostrará dónde está la mesa</translation>
    </message>
    <message>
        <source>not known: 3 points fit any circle</source>
        <translation>desconocido: por 3 puntos siempre pasa un círculo</translation>
    </message>
    <message>
        <source>The detected platter differs by %1 in its centre, %2 in its radius</source>
        <translation>El plato detectado difiere en %1 en su centro y en %2 en su radio</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SectionPanel</name>
    <message>
        <source>Section</source>
        <translation>Sección</translation>
    </message>
    <message>
        <source>Cut all models open by a plane, and close the selected one</source>
        <translation>Cortar todos los modelos por un plano y cerrar el seleccionado</translation>
    </message>
    <message>
        <source>Export DXF…</source>
        <translation>Exportar DXF…</translation>
    </message>
    <message>
        <source>The contours as a drawing in millimetres</source>
        <translation>Los contornos como dibujo en milímetros</translation>
    </message>
    <message>
        <source>Export SVG…</source>
        <translation>Exportar SVG…</translation>
    </message>
    <message>
        <source>Drawing (*.dxf)</source>
        <translation>Dibujo (*.dxf)</translation>
    </message>
    <message>
        <source>Drawing (*.svg)</source>
        <translation>Dibujo (*.svg)</translation>
    </message>
    <message>
        <source>, %1 of them open: the mesh has holes there</source>
        <translation>, %1 de ellos abiertos: la malla tiene agujeros ahí</translation>
    </message>
    <message>
        <source>The plane does not meet the selected model</source>
        <translation>El plano no corta el modelo seleccionado</translation>
    </message>
    <message>
        <source>%1 contours%2, area %3 cm², length %4 mm</source>
        <translation>%1 contornos%2, área %3 cm², longitud %4 mm</translation>
    </message>
    <message>
        <source>Export the section</source>
        <translation>Exportar la sección</translation>
    </message>
    <message>
        <source>Export %1</source>
        <translation>Exportar %1</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Se escribió %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SessionKeeper</name>
    <message>
        <source>The session is not saved: %1 cannot be made</source>
        <translation>La sesión no se conserva: no se puede crear %1</translation>
    </message>
    <message>
        <source>The session is not saved: %1</source>
        <translation>La sesión no se conserva: %1</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SheetDialog</name>
    <message>
        <source>Stages</source>
        <translation>Etapas</translation>
    </message>
    <message>
        <source>Save the stages</source>
        <translation>Guardar las etapas</translation>
    </message>
    <message>
        <source>PNG (*.png)</source>
        <translation>PNG (*.png)</translation>
    </message>
    <message>
        <source>%1 cannot be written; check the folder and its permissions</source>
        <translation>%1 no se puede escribir; compruebe la carpeta y sus permisos</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SidePanel</name>
    <message>
        <source>Show what no view saw</source>
        <translation>Mostrar lo que ninguna vista vio</translation>
    </message>
    <message>
        <source>Surface that was closed without a measurement, in magenta</source>
        <translation>Superficie que se cerró sin medirla, en magenta</translation>
    </message>
    <message>
        <source>Scan another side</source>
        <translation>Escanear otro lado</translation>
    </message>
    <message>
        <source>Lay the object another way and record it again; the passes become one mesh</source>
        <translation>Coloque el objeto de otra forma y grábelo de nuevo; las pasadas forman una sola malla</translation>
    </message>
    <message>
        <source>Select a mesh that was made from a recording: what no view saw of it, and how to lay it for the next pass, stands here.</source>
        <translation>Seleccione una malla hecha a partir de una grabación: aquí se indica lo que ninguna vista vio y cómo colocar el objeto para la próxima pasada.</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SimulatorMode</name>
    <message>
        <source>Loading the object</source>
        <translation>Cargando el objeto</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objeto</translation>
    </message>
    <message>
        <source>File…</source>
        <translation>Archivo…</translation>
    </message>
    <message>
        <source>Any mesh: PLY, STL, OBJ, OFF, 3MF, GLB, …</source>
        <translation>Cualquier malla: PLY, STL, OBJ, OFF, 3MF, GLB, …</translation>
    </message>
    <message>
        <source>How it stands</source>
        <translation>Cómo está colocado</translation>
    </message>
    <message>
        <source>Object to scan</source>
        <translation>Objeto que se escanea</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>Escena</translation>
    </message>
    <message>
        <source>Load scene…</source>
        <translation>Cargar escena…</translation>
    </message>
    <message>
        <source>A scene file, as turnscan simulate reads it</source>
        <translation>Un archivo de escena, como lo lee turnscan simulate</translation>
    </message>
    <message>
        <source>Save scene…</source>
        <translation>Guardar escena…</translation>
    </message>
    <message>
        <source>Everything here as a file for --scene</source>
        <translation>Todo esto como archivo para --scene</translation>
    </message>
    <message>
        <source>Scenes (*.toml)</source>
        <translation>Escenas (*.toml)</translation>
    </message>
    <message>
        <source>Load scene</source>
        <translation>Cargar escena</translation>
    </message>
    <message>
        <source>Save scene</source>
        <translation>Guardar escena</translation>
    </message>
    <message>
        <source>Coverage</source>
        <translation>Cobertura</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Grabación</translation>
    </message>
    <message>
        <source>Folder to create for the recording; if it exists, it must be empty</source>
        <translation>Carpeta que se crea para la grabación; no debe existir o debe estar vacía</translation>
    </message>
    <message>
        <source>…</source>
        <translation>…</translation>
    </message>
    <message>
        <source>Choose the folder</source>
        <translation>Elegir la carpeta</translation>
    </message>
    <message>
        <source>Scan</source>
        <translation>Escanear</translation>
    </message>
    <message>
        <source>Record the object with all scanners</source>
        <translation>Grabar el objeto con todos los escáneres</translation>
    </message>
    <message>
        <source>Open in Explorer</source>
        <translation>Abrir en el Explorador</translation>
    </message>
    <message>
        <source>Load the recording in the Model Explorer</source>
        <translation>Cargar la grabación en el Explorador de modelos</translation>
    </message>
    <message>
        <source>Reconstruct</source>
        <translation>Reconstruir</translation>
    </message>
    <message>
        <source>Load it there and run every stage</source>
        <translation>Cargarla allí y ejecutar todas las etapas</translation>
    </message>
    <message>
        <source>Folder of the recording</source>
        <translation>Carpeta de la grabación</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>Vista previa</translation>
    </message>
    <message>
        <source>There is no scanner; add one first</source>
        <translation>No hay ningún escáner; añada uno primero</translation>
    </message>
    <message>
        <source>What was covered</source>
        <translation>Lo que se cubrió</translation>
    </message>
    <message>
        <source>Density of samples</source>
        <translation>Densidad de muestras</translation>
    </message>
    <message>
        <source>Why it was missed</source>
        <translation>Por qué faltó</translation>
    </message>
    <message>
        <source>The samples only</source>
        <translation>Solo las muestras</translation>
    </message>
    <message>
        <source>Hole</source>
        <translation>Hueco</translation>
    </message>
    <message>
        <source>Size, mm</source>
        <translation>Tamaño, mm</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Motivo</translation>
    </message>
    <message>
        <source>The largest holes; click one to fly there.</source>
        <translation>Los huecos mayores; haga clic en uno para ir allí.</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>Se escribió %1</translation>
    </message>
    <message>
        <source>%1 cm²</source>
        <translation>%1 cm²</translation>
    </message>
    <message>
        <source>Scanners</source>
        <translation>Escáneres</translation>
    </message>
    <message>
        <source>Add scanner</source>
        <translation>Añadir escáner</translation>
    </message>
    <message>
        <source>Matrix and line scanners from presets</source>
        <translation>Escáneres matriciales y de línea predefinidos</translation>
    </message>
    <message>
        <source>From file…</source>
        <translation>De un archivo…</translation>
    </message>
    <message>
        <source>Scanner</source>
        <translation>Escáner</translation>
    </message>
    <message>
        <source>Scanners (*.toml)</source>
        <translation>Escáneres (*.toml)</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Quitar</translation>
    </message>
    <message>
        <source>Remove the selected scanner</source>
        <translation>Quitar el escáner seleccionado</translation>
    </message>
    <message>
        <source>Drag a scanner in the view to move it, with Shift nearer or farther, or type its place:</source>
        <translation>Arrastre un escáner en la vista para moverlo, con Mayús más cerca o más lejos, o escriba su posición:</translation>
    </message>
    <message>
        <source>change of the rig</source>
        <translation>cambio del montaje</translation>
    </message>
    <message>
        <source>What the colours show</source>
        <translation>Lo que muestran los colores</translation>
    </message>
    <message>
        <source>The largest holes</source>
        <translation>Los huecos mayores</translation>
    </message>
    <message>
        <source>Sweep</source>
        <translation>Barrido</translation>
    </message>
    <message>
        <source>Coverage of the selected scanner as it is turned:</source>
        <translation>Cobertura del escáner seleccionado al girarlo:</translation>
    </message>
    <message>
        <source>The scanner that was swept is no longer there</source>
        <translation>El escáner del barrido ya no está</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::StagePanel</name>
    <message>
        <source>Reconstruct</source>
        <translation>Reconstruir</translation>
    </message>
    <message>
        <source>Run every stage on the selected recording or cloud (Ctrl+R)</source>
        <translation>Ejecutar todas las etapas con la grabación o nube seleccionada (Ctrl+R)</translation>
    </message>
    <message>
        <source>Load preset…</source>
        <translation>Cargar…</translation>
    </message>
    <message>
        <source>Options from a TOML file</source>
        <translation>Opciones de un archivo TOML</translation>
    </message>
    <message>
        <source>Save preset…</source>
        <translation>Guardar…</translation>
    </message>
    <message>
        <source>Options as a TOML file for --config</source>
        <translation>Opciones como archivo TOML para --config</translation>
    </message>
    <message>
        <source>Defaults</source>
        <translation>Restablecer</translation>
    </message>
    <message>
        <source>Set all options back</source>
        <translation>Devolver todas las opciones a su valor inicial</translation>
    </message>
    <message>
        <source>Presets (*.toml)</source>
        <translation>Ajustes (*.toml)</translation>
    </message>
    <message>
        <source>Load preset</source>
        <translation>Cargar ajustes</translation>
    </message>
    <message>
        <source>Save preset</source>
        <translation>Guardar ajustes</translation>
    </message>
    <message>
        <source>Filter the cloud</source>
        <translation>Filtrar la nube</translation>
    </message>
    <message>
        <source>Drop outliers of the selected cloud; adds a new model</source>
        <translation>Descartar los valores atípicos de la nube seleccionada; añade un modelo nuevo</translation>
    </message>
    <message>
        <source>Run the stages up to this one; adds its cloud as a new model</source>
        <translation>Ejecutar las etapas hasta esta; añade su nube como modelo nuevo</translation>
    </message>
    <message>
        <source>Not at the defaults: %1. &lt;a href=&quot;reset&quot;&gt;Reset&lt;/a&gt;</source>
        <translation>Distinto de lo predeterminado: %1. &lt;a href=&quot;reset&quot;&gt;Restablecer&lt;/a&gt;</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::SweepPanel</name>
    <message>
        <source>Sweep</source>
        <translation>Barrido</translation>
    </message>
    <message>
        <source>Find the coverage with each of the values</source>
        <translation>Calcular la cobertura con cada uno de los valores</translation>
    </message>
    <message>
        <source>Use the best</source>
        <translation>Usar el mejor</translation>
    </message>
    <message>
        <source>Place the scanner where it covers most</source>
        <translation>Colocar el escáner donde más cubre</translation>
    </message>
    <message>
        <source>Option to sweep</source>
        <translation>Opción que se barre</translation>
    </message>
    <message>
        <source>Values: from..to/step</source>
        <translation>Valores: desde..hasta/paso</translation>
    </message>
    <message>
        <source>%1 at %2 covers most: %3 % of the surface</source>
        <translation>%1 en %2 cubre más: %3 % de la superficie</translation>
    </message>
    <message>
        <source>From, to and step in degrees, e.g. -45..45/15</source>
        <translation>Desde, hasta y paso en grados, p. ej. -45..45/15</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not from..to/step in degrees, e.g. -45..45/15</source>
        <translation>«%1» no es desde..hasta/paso en grados, p. ej. -45..45/15</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::TurntableMovie</name>
    <message>
        <source>The view was closed</source>
        <translation>La vista se cerró</translation>
    </message>
    <message>
        <source>%1 cannot be written</source>
        <translation>No se puede escribir %1</translation>
    </message>
    <message>
        <source>Picture %1 of %2</source>
        <translation>Imagen %1 de %2</translation>
    </message>
    <message>
        <source>Make the film</source>
        <translation>Hacer la película</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::VerdictPanel</name>
    <message>
        <source>Verdict</source>
        <translation>Veredicto</translation>
    </message>
    <message>
        <source>Colours of the mesh</source>
        <translation>Colores de la malla</translation>
    </message>
    <message>
        <source>What the colours of the selected mesh show</source>
        <translation>Lo que muestran los colores de la malla seleccionada</translation>
    </message>
    <message>
        <source>Export report…</source>
        <translation>Informe…</translation>
    </message>
    <message>
        <source>One HTML file with the model in 3D, the verdict, pictures and plots</source>
        <translation>Un archivo HTML con el modelo en 3D, el veredicto, imágenes y gráficas</translation>
    </message>
    <message>
        <source>Own colours</source>
        <translation>Colores propios</translation>
    </message>
    <message>
        <source>Select a mesh that was made from a recording: how good it is, and why, stands here. One that was edited, opened from a file or restored has no verdict; reconstruct its recording for one.</source>
        <translation>Seleccione una malla hecha de una grabación: aquí se dice cómo es de buena y por qué. Una que se editó, se abrió de un archivo o se restauró no tiene veredicto; reconstruya su grabación para tenerlo.</translation>
    </message>
    <message>
        <source>Other findings</source>
        <translation>Otros resultados</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::ViewPanel</name>
    <message>
        <source>Bounding boxes</source>
        <translation>Cajas</translation>
    </message>
    <message>
        <source>Draw the box around each model (B)</source>
        <translation>Dibujar la caja alrededor de cada modelo (B)</translation>
    </message>
    <message>
        <source>How fast mouse and keys move the camera</source>
        <translation>Con qué rapidez mueven la cámara el ratón y las teclas</translation>
    </message>
    <message>
        <source>Size of points on the screen</source>
        <translation>Tamaño de los puntos en pantalla</translation>
    </message>
    <message>
        <source>Camera speed</source>
        <translation>Velocidad</translation>
    </message>
    <message>
        <source>Point size</source>
        <translation>Puntos</translation>
    </message>
</context>
<context>
    <name>turnscan::studio::VoxelPanel</name>
    <message>
        <source>As cubes</source>
        <translation>Como cubos</translation>
    </message>
    <message>
        <source>Use for Voxelise</source>
        <translation>Usar al voxelizar</translation>
    </message>
    <message>
        <source>Make this the option voxel-min-points of the next runs</source>
        <translation>Usarlo como opción voxel-min-points de las próximas ejecuciones</translation>
    </message>
    <message>
        <source>Least count of a cell that is shown</source>
        <translation>Número mínimo de puntos de una celda mostrada</translation>
    </message>
    <message>
        <source>At least</source>
        <translation>Al menos</translation>
    </message>
    <message>
        <source>%1 of %2 cells have at least %3 points</source>
        <translation>%1 de %2 celdas tienen al menos %3 puntos</translation>
    </message>
    <message>
        <source>Cubes</source>
        <translation>Cubos</translation>
    </message>
    <message>
        <source>Points in a cell</source>
        <translation>Puntos por celda</translation>
    </message>
    <message>
        <source> and more</source>
        <translation> y más</translation>
    </message>
    <message>
        <source>%1 of %2 cells have at least %3 lines</source>
        <translation>%1 de %2 celdas tienen al menos %3 líneas</translation>
    </message>
    <message>
        <source>Lines through a cell</source>
        <translation>Líneas por celda</translation>
    </message>
</context>
</TS>
