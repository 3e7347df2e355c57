# SPDX-License-Identifier: GPL-3.0-or-later
"""Deutsch.

Wörter: part Teil, cut Schnitt, boundary Grenze, crease Falte, node Knoten, arc Bogen, loop Schleife, empty
Leerobjekt, vertex Punkt, face Fläche, border Rand, seam Naht, armature Skelett, piece Stück; wo Blenders
deutsche Oberfläche selbst beim Englischen bleibt (Face Set, Geometry Nodes, Dyntopo), bleibt es auch hier.
"""

OPERATORS = {
    # Der Reiter
    "Decompose": "Zerlegen",
    "Decompose into Parts": "In Teile zerlegen",
    "Cancel": "Abbrechen",
    "Clear Parts": "Zerlegung entfernen",
    "Fewer Parts": "Weniger Teile",
    "More Parts": "Mehr Teile",
    "Fewer or More Parts": "Weniger oder mehr Teile",
    "Check Parts": "Teile prüfen",
    "Check": "Prüfen",
    "Repair Part": "Teil reparieren",
    "Repair": "Reparieren",
    "Select What Is Wrong": "Fehlerhaftes auswählen",
    "Reset Parameters to Preset": "Parameter auf Vorgabe zurücksetzen",
    "Use Preferences in This Scene": "Einstellungen in dieser Szene verwenden",
    # Die Liste der Teile
    "Select": "Auswählen",
    "Select Faces of Parts": "Flächen der Teile auswählen",
    "Isolate": "Isolieren",
    "Isolate Parts": "Teile isolieren",
    "Show All": "Alles zeigen",
    "Show All Parts": "Alle Teile zeigen",
    "Mark Parts": "Teile ankreuzen",
    "Find Similar Parts": "Ähnliche Teile finden",
    "Names from Active": "Namen vom aktiven Objekt",
    "Pick Parts": "Teile anklicken",
    # Teile von Hand
    "Merge Parts": "Teile zusammenführen",
    "Merge into Neighbor": "Mit Nachbarn zusammenführen",
    "Merge Small": "Kleine zusammenführen",
    "Merge Small Parts": "Kleine Teile zusammenführen",
    "Frame Parts": "Teile heranholen",
    "Suggest Names": "Namen vorschlagen",
    "Split Parts": "Teile teilen",
    "Split at Graph Node": "Am Graphknoten teilen",
    "Cut Part at Point": "Teil am Punkt schneiden",
    "Grow Parts": "Teile vergrößern",
    "Shrink Parts": "Teile verkleinern",
    "Slide Boundary": "Grenze verschieben",
    "Paint into Part": "In Teil malen",
    "Assign Faces to Part": "Flächen dem Teil zuweisen",
    "New Part of Selected Faces": "Neues Teil aus Auswahl",
    "Parts from Face Sets": "Teile aus Face Sets",
    "Release Parts": "Teile freigeben",
    "Release All Parts": "Alle Teile freigeben",
    # Der Graph
    "Nodes of Chosen Parts": "Knoten der gewählten Teile",
    "Show or Hide Graph": "Graph zeigen oder verbergen",
    "Show Colors": "Farben zeigen",
    "Show Colors of Parts": "Farben der Teile zeigen",
    "Give Materials": "Materialien geben",
    "Parts of Selected Nodes": "Teile der ausgewählten Knoten",
    "Part of Arc": "Teil des Bogens",
    # Teile verwenden
    "Separate": "Trennen",
    "Separate Parts into Objects": "Teile in Objekte trennen",
    "Show Original of Part": "Original des Teils zeigen",
    "Show Separated Parts": "Abgetrennte Teile zeigen",
    "Seams": "Nähte",
    "Mark Seams between Parts": "Nähte zwischen Teilen markieren",
    "Face Sets": "Face Sets",
    "Make Face Sets of Parts": "Face Sets aus Teilen erstellen",
    "Materials": "Materialien",
    "Give Each Part a Material": "Jedem Teil ein Material geben",
    "Unwrap along Cuts": "Entlang der Schnitte abwickeln",
    "Export to Files...": "In Dateien exportieren...",
    "Export Parts to Files": "Teile exportieren",
    "Make Collision Hulls": "Kollisionshüllen erstellen",
    "Make Collision Hulls of Parts": "Kollisionshüllen aus Teilen erstellen",
    "Make Rigid Bodies": "Starrkörper erstellen",
    "Make Rigid Bodies of Parts": "Starrkörper aus Teilen erstellen",
    "Make Armature": "Skelett erstellen",
    "Make Armature from Parts": "Skelett aus Teilen erstellen",
    "Choose Parts": "Teile wählen",
    "Hide Parts": "Teile verbergen",
    "Keep Object": "Objekt behalten",
    "Rename Part": "Teil umbenennen",
    "Grow to Next Crease": "Bis zur nächsten Falte vergrößern",
    "Shrink to Next Crease": "Bis zur nächsten Falte verkleinern",
}

TOOLS = {
    "Fewer": "Weniger",
    "More": "Mehr",
    "Pick": "Anklicken",
    "Cut": "Schneiden",
    "Slide": "Schieben",
    "Paint": "Malen",
    "Action": "Aktion",
    "Set": "Setzen",
    "Extend": "Erweitern",
    "Subtract": "Abziehen",
    "Cuts": "Schnitte",
    "Planar": "Eben",
    "Smooth": "Glatt",
    "Along Faces": "An Flächen",
    "Joints": "Verbindungen",
    "Joint": "Verbindung",
    "As All": "Wie alle",
    "Round Pegs": "Runde Zapfen",
    "Square Pegs": "Eckige Zapfen",
    "Keys": "Schwalbenschwänze",
    "Dowels": "Dübel",
    "Magnets": "Magnete",
    "None": "Keine",
    "Merge": "Zusammenführen",
    "Grow": "Vergrößern",
    "Rename": "Umbenennen",
    "Hide": "Verbergen",
    "Frame": "Heranholen",
    # Methode und Stücke
    "Method": "Methode",
    "Perceptual": "Wahrnehmung",
    "Berretti": "Berretti",
    "Lavoue": "Lavoué",
    "Liu": "Liu",
    "Pieces": "Stücke",
    "Together": "Gemeinsam",
    "Separate": "Getrennt",
}

TEXTS = {
    # Der Reiter und seine Felder
    "Reeb Parts": "Reeb Parts",
    "Parts": "Teile",
    "Use Parts": "Verwenden",
    "Separated Part": "Abgetrenntes Teil",
    "Field": "Feld",
    "Graph": "Graph",
    "Boundaries": "Grenzen",
    "Output": "Ausgabe",
    "Overlay": "Überlagern",
    "{n} {n:part|parts}": "{n} {n:Teil|Teile}",
    "{parts} in {seconds:.2f} s": "{parts} in {seconds:.2f} s",
    "{n} {n:node|nodes}": "{n} Knoten",
    "{n} {n:arc|arcs}": "{n} {n:Bogen|Bögen}",
    "{n} {n:loop|loops}": "{n} {n:Schleife|Schleifen}",
    "{nodes}, {arcs}, {loops}": "{nodes}, {arcs}, {loops}",
    "Advanced": "Erweitert",
    # Vorschläge für Namen
    "Name the parts that you have not named by what they are: head, leg, handle; else by their place and kind":
        "Die Teile, die noch keinen eigenen Namen haben, danach benennen, was sie sind: Kopf, Bein, Henkel; sonst nach "
        "Art und Lage",
    "All named already: {n} {n:part|parts}": "Alle schon benannt: {n} {n:Teil|Teile}",
    "{n} {n:part is|parts are} named": "{n} {n:Teil ist|Teile sind} benannt",
    "{place} {kind}": "{kind} {place}",
    "body": "Körper", "head": "Kopf", "neck": "Hals", "arm": "Arm", "leg": "Bein", "tail": "Schwanz", "ear": "Ohr",
    "horn": "Horn", "handle": "Henkel", "ground": "Boden", "limb": "Glied", "tip": "Spitze", "piece": "Stück",
    "front": "vorn",
    "back": "hinten", "top": "oben", "bottom": "unten", "left": "links", "right": "rechts",
    "This viewport does not show the parts.": "Diese Ansicht zeigt die Teile nicht.",
    "and {n} more {n:model|models}": "und {n} {n:weiteres Modell|weitere Modelle}",
    "{names} and {n} more": "{names} und {n} mehr",
    "Show the parts' colors in this viewport: Solid, colored by attribute":
        "Die Farben der Teile in dieser Ansicht zeigen: Solid, nach Attribut gefärbt",
    "The parts have no colors. Switch these on under Advanced, Output; decompose again.":
        "Die Teile haben keine Farben. Bitte unter „Erweitert“, „Ausgabe“ einschalten und erneut zerlegen.",
    "Show the Reeb graphs over the selected models, or hide them":
        "Die Reeb-Graphen über den ausgewählten Modellen zeigen oder verbergen",
    "{n} Small {n:Part|Parts}": "{n} {n:kleines Teil|kleine Teile}",
    "Sort": "Sortieren",
    "Size": "Größe",
    "Place": "Lage",
    "In the order of their numbers: those of fewer parts first": "Nach ihren Nummern, die von weniger Teilen zuerst",
    "Largest first": "Die größten zuerst",
    "By name": "Nach Namen",
    "Highest first": "Die obersten zuerst",
    "The order of the parts in the list": "Die Reihenfolge der Teile in der Liste",
    "Show Small Parts": "Kleine Teile zeigen",
    "List the parts, too, that are smaller than the share set under Advanced, Overlay":
        "Auch die Teile nennen, die kleiner sind als der Anteil unter „Erweitert“, „Überlagern“",
    "Small Below": "Klein unter",
    "Parts of a smaller share of the surface are folded into one row where the list is long":
        "Teile mit einem kleineren Anteil an der Oberfläche stehen in langen Listen zusammen in einer Zeile",
    "Merge each of the small parts into the neighbor that it is least clearly cut from":
        "Jedes der kleinen Teile mit dem Nachbarn zusammenführen, von dem es am undeutlichsten getrennt ist",
    "There are no small parts to merge.": "Es gibt keine kleinen Teile zum Zusammenführen.",
    "{n} small {n:part is|parts are} merged": "{n} {n:kleines Teil ist|kleine Teile sind} zusammengeführt",
    "Look at the chosen parts from near": "Die gewählten Teile aus der Nähe zeigen",
    "Decompose cuts the selected mesh into parts. The mesh itself stays as it is.":
        "„Zerlegen“ zerschneidet das ausgewählte Mesh in Teile. Das Mesh selbst bleibt, wie es ist.",
    "Select a mesh, then press Decompose.": "Bitte ein Mesh auswählen, dann „Zerlegen“ drücken.",
    "The mesh was edited since. Decompose it again.": "Das Mesh wurde seither bearbeitet. Bitte erneut zerlegen.",
    "{n} {n:note|notes} on the mesh": "{n} {n:Hinweis|Hinweise} zum Mesh",
    "{n} {n:note|notes}": "{n} {n:Hinweis|Hinweise}",
    "{n} {n:part|parts} cannot be had, only {fewest} to {most}":
        "{n} {n:Teil|Teile} gibt es nicht, nur {fewest} bis {most}",
    "Go to the next number of parts that stands out, such as all limbs, or all fingers":
        "Zur nächsten Zahl von Teilen, die heraussticht, etwa mit allen Gliedern oder allen Fingern",
    "More": "Mehr",
    "More parts; without it, fewer": "Mehr Teile, sonst weniger",
    "There are no more parts than these.": "Mehr Teile als diese gibt es nicht.",
    "There are no fewer parts than these.": "Weniger Teile als diese gibt es nicht.",
    "{part} of {name}": "{part} von {name}",
    "A part of {name}": "Ein Teil von {name}",
    "Show {name}": "{name} zeigen",
    "Show Originals": "Originale zeigen",
    "New scenes start with these settings.": "Neue Szenen beginnen mit diesen Einstellungen.",
    # Wie weit die Berechnung ist
    "Reeb Parts: {stage} ({share:.0%})    Esc: cancel": "Reeb Parts: {stage} ({share:.0%})    Esc: abbrechen",
    "Reeb Parts: {stage} ({share:.0%})    Blender stands still until the parts are there":
        "Reeb Parts: {stage} ({share:.0%})    Blender steht still, bis die Teile da sind",
    "mesh": "Mesh",
    "distances": "Abstände",
    "reeb graph": "Reeb-Graph",
    "cuts": "Schnitte",
    "separating parts": "Teile werden getrennt",
    "reading the mesh": "Mesh wird gelesen",
    "starting": "Start",
    "writing the parts": "Teile werden geschrieben",
    "parts": "Teile",
    "done": "fertig",
    # Parameter
    "Preset": "Vorgabe",
    "Set all parameters at once": "Alle Parameter auf einmal setzen",
    "Perceptual": "Wahrnehmung",
    "Berretti 2009": "Berretti 2009",
    "Method": "Methode",
    "Lavoue 2005": "Lavoué 2005",
    "Liu 2007": "Liu 2007",
    "How cuts are chosen: as people would, by the paper's rules on the Reeb graph, where curvature changes, or by "
    "cutting in two again and again":
        "Wie Schnitte gewählt werden: so, wie Menschen schneiden würden, nach den Regeln des Artikels auf dem "
        "Reeb-Graphen, wo sich die Krümmung ändert, oder durch immer neues Teilen in zwei",
    "Curvature Classes": "Krümmungsklassen",
    "Lavoue 2005: number of classes of curvature that the surface is sorted into; 0 chooses it from the data":
        "Lavoué 2005: Anzahl der Krümmungsklassen, in die die Oberfläche eingeteilt wird; 0 wählt sie aus den Daten",
    "Outline": "Umrandung",
    "Liu 2007: how far the outline of a part, unfolded into the plane, counts when its cut is judged; 0 judges by the "
    "cut alone":
        "Liu 2007: wie sehr die Umrandung eines in die Ebene ausgebreiteten Teils zählt, wenn sein Schnitt beurteilt "
        "wird; 0 urteilt nur nach dem Schnitt",
    "The name of the part until the user gives it another":
        "Der Name des Teils, bis der Benutzer ihm einen anderen gibt",
    "Symmetry": "Symmetrie",
    "Where the model is its own mirror image, or most of it is, make its parts so, too. Changes by hand are made on "
    "both sides":
        "Wo das Modell sein eigenes Spiegelbild ist, ganz oder zum größten Teil, die Teile ebenso bilden. Änderungen "
        "von Hand geschehen auf beiden Seiten",
    "Hints": "Hinweise",
    "Along UV seams": "Entlang von UV-Nähten",
    "Along edges that are marked sharp": "Entlang von Kanten, die als scharf markiert sind",
    "Hints must be one whole number for each of the {n} faces.":
        "Hinweise müssen eine ganze Zahl für jede der {n} Flächen sein.",
    "Seams": "Nähte",
    "Sharp Edges": "Scharfe Kanten",
    "The shape alone decides": "Die Form allein entscheidet",
    "What you have marked on the mesh yourself that parts should follow, besides its shape":
        "Was Sie selbst auf dem Mesh markiert haben und dem Teile außer der Form folgen sollen",
    "Where the material changes": "Wo das Material wechselt",
    "Whether pieces that touch without being joined form parts together, like a sleeve and an arm, or each piece is "
    "decomposed on its own":
        "Ob Stücke, die sich berühren, ohne verbunden zu sein, gemeinsam Teile bilden, wie Ärmel und Arm, oder jedes "
        "Stück für sich zerlegt wird",
    "Detail": "Detail",
    "How readily the surface is cut: 0 gives as few parts as possible, 1 every candidate":
        "Wie bereitwillig die Oberfläche zerschnitten wird: 0 ergibt so wenige Teile wie möglich, 1 alle, die "
        "in Frage kommen",
    "How readily the surface is cut: 0 gives as few parts as possible, 1 every candidate. Nothing is computed again":
        "Wie bereitwillig die Oberfläche zerschnitten wird: 0 ergibt so wenige Teile wie möglich, 1 alle, die "
        "in Frage kommen. Nichts wird neu berechnet",
    "Number of Parts": "Anzahl der Teile",
    "Exactly this many parts instead of a level of detail; 0 lets Detail decide":
        "Genau so viele Teile statt eines Detailgrads; bei 0 entscheidet Detail",
    "Exactly this many parts, whatever the detail. Nothing is computed again":
        "Genau so viele Teile, unabhängig vom Detail. Nichts wird neu berechnet",
    "Base Spacing": "Basisabstand",
    "Share of the area around each point that distances are measured from; smaller is slower and finer (the "
    "paper's 0.005 S)":
        "Anteil der Oberfläche um jeden Punkt, von dem aus Abstände gemessen werden; kleiner ist langsamer und "
        "feiner (0.005 S im Artikel)",
    "Equalize": "Ausgleichen",
    "Give every range of distances the same area, so that long limbs do not hide short ones (the paper's s(p))":
        "Jedem Bereich von Abständen gleich viel Fläche geben, damit lange Gliedmaßen kurze nicht verdecken (s(p) "
        "im Artikel)",
    "Levels": "Stufen",
    "Number of slabs the surface is cut into before parts are formed (1 / epsilon)":
        "Anzahl der Scheiben, in die die Oberfläche geschnitten wird, bevor Teile entstehen (1 / Epsilon)",
    "Small Region": "Kleine Region",
    "Berretti 2009: parts smaller than this share of the largest one join a neighbor; 0.01 keeps fingers":
        "Berretti 2009: Teile, die kleiner als dieser Anteil des größten sind, gehen in einem Nachbarn auf; 0.01 "
        "erhält Finger",
    "Concavity": "Konkavität",
    "Berretti 2009: how far a cut may slide to lie in a crease; 0 leaves it where it is (the paper's alpha)":
        "Berretti 2009: wie weit ein Schnitt rutschen darf, um in einer Falte zu liegen; 0 lässt ihn, wo er ist "
        "(Alpha im Artikel)",
    "Band": "Band",
    "How far to either side a cut may move into a crease, as a share of the radius of a circle as long as the cut; 0 "
    "leaves it where it is":
        "Wie weit ein Schnitt zu beiden Seiten in eine Falte rücken darf, als Anteil des Radius eines Kreises, der so "
        "lang wie der Schnitt ist; 0 lässt ihn, wo er ist",
    "The parameter {old} is called {new} now.": "Der Parameter {old} heißt jetzt {new}.",
    "The model {file} was trained on other features (first: {name}). Train it again.":
        "Das Modell {file} wurde an anderen Merkmalen angelernt (das erste: {name}). Es muss neu angelernt werden.",
    "The model {file} was trained on the features in another order. Train it again.":
        "Das Modell {file} wurde an den Merkmalen in anderer Reihenfolge angelernt. Es muss neu angelernt werden.",
    "Crease Length": "Faltenlänge",
    "Berretti 2009: how much of a cut's length must be concave to count (the paper's sigma)":
        "Berretti 2009: wie viel von der Länge eines Schnitts konkav sein muss, um zu zählen (Sigma im Artikel)",
    "Smoothing": "Glättung",
    "Rounds that take saw teeth off the cuts, a face at a time; 0 leaves them as they fall":
        "Durchgänge, die den Schnitten Fläche für Fläche die Sägezähne nehmen; 0 lässt sie, wie sie sind",
    "Follow Level Sets": "Niveaulinien folgen",
    "Keep cuts on level sets of the distance, as the paper does; off, they follow creases":
        "Schnitte wie im Artikel auf Linien gleichen Abstands belassen; ausgeschaltet folgen sie Falten",
    "Small Loose Part": "Lose Teile ab",
    "What touches nothing else, or with Pieces: Separate each loose piece, is one part if its share of the whole "
    "area is less than this":
        "Was nichts anderes berührt, oder bei Stücke: Getrennt jedes lose Stück, ist ein einziges Teil, wenn sein "
        "Anteil an der ganzen Oberfläche kleiner ist",
    # Ausgabe
    "Vertex Groups": "Punktgruppen",
    "A vertex group for each part; vertices on a cut belong to every part that meets there":
        "Eine Punktgruppe für jedes Teil; Punkte auf einem Schnitt gehören zu allen Teilen, die dort aneinandergrenzen",
    "Face Attribute": "Flächenattribut",
    "The number of each face's part as the attribute reeb_part, for Geometry Nodes":
        "Für jede Fläche die Nummer ihres Teils als Attribut reeb_part, für Geometry Nodes",
    "Colors": "Farben",
    "The parts' colors as the active color attribute Reeb Parts":
        "Die Farben der Teile als aktives Farbattribut Reeb Parts",
    "Palette": "Palette",
    "What the parts' colors are chosen from. A color that you give to a part in the list stays the part's own":
        "Woraus die Farben der Teile gewählt werden. Eine Farbe, die ein Teil in der Liste erhält, behält es",
    "Color-Blind Safe": "Für Farbenblinde",
    "Bright": "Kräftig",
    "Pastel": "Pastell",
    "Face Sets": "Face Sets",
    "A face set for each part, for Sculpt Mode; Clear brings your own back":
        "Ein Face Set für jedes Teil, für den Skulpturmodus; „Zerlegung entfernen“ stellt die eigenen wieder her",
    "Materials": "Materialien",
    "A material for each part; Clear brings your own back":
        "Ein Material für jedes Teil; „Zerlegung entfernen“ stellt die eigenen wieder her",
    "Seams along Cuts": "Nähte an Schnitten",
    "UV seams where parts meet, beside your own; Clear removes only these":
        "UV-Nähte, wo Teile aneinandergrenzen, neben den eigenen; „Zerlegung entfernen“ entfernt nur diese",
    "Distance Field": "Abstandsfeld",
    "The normalized average geodesic distance that the parts come from, as the vertex attribute reeb_agd: 0 in the "
    "middle of the body, 1 at the farthest tip":
        "Der normierte mittlere geodätische Abstand, aus dem die Teile hervorgehen, als Punktattribut reeb_agd: 0 in "
        "der Mitte des Körpers, 1 an der entferntesten Spitze",
    "The Reeb graph as objects: an empty for each node, a curve for the arcs":
        "Der Reeb-Graph als Objekte: ein Leerobjekt für jeden Knoten, eine Kurve für die Bögen",
    # Überlagerung
    "Node Size": "Knotengröße",
    "Size of the empties, as a share of the object's": "Größe der Leerobjekte, als Anteil der Größe des Objekts",
    "Line Thickness": "Linienstärke",
    "Thickness of the curve under the lines, as a share of the radius of the body around it":
        "Stärke der Kurve unter den Linien, als Anteil des Radius des Körpers um sie herum",
    "In Front": "Im Vordergrund",
    "Draw the graph over the model instead of hidden inside it":
        "Den Graphen über das Modell zeichnen, statt in ihm verborgen",
    "Outline Chosen Parts": "Gewählte Teile umranden",
    "Draw a line around the parts that are chosen in the list":
        "Eine Linie um die Teile zeichnen, die in der Liste gewählt sind",
    "Show Cuts": "Schnitte zeigen",
    "Draw all borders between parts where Separate would cut them, by its setting Cuts":
        "Alle Grenzen zwischen Teilen dort zeichnen, wo „Trennen“ sie nach „Schnitte“ schneiden würde",
    "The parameters that new scenes start with": "Die Parameter, mit denen neue Szenen beginnen",
    "The preferences were taken over": "Die Einstellungen wurden übernommen",
    # Die Liste der Teile
    "Name": "Name",
    "Name of the part and of its vertex group; double click to change it":
        "Name des Teils und seiner Punktgruppe; zum Ändern doppelt klicken",
    "Number": "Nummer",
    "What the part is known by; the value of reeb_part": "Woran das Teil erkannt wird; der Wert von reeb_part",
    "Color": "Farbe",
    "Color of the part; one that you choose stays with it":
        "Farbe des Teils; eine selbst gewählte bleibt bei ihm",
    "Empty: the part's own": "Leer: der eigene Name des Teils",
    "Share": "Anteil",
    "Share of the surface's area": "Anteil an der Oberfläche",
    "Locked": "Gesperrt",
    "The part stays as it is, whatever the detail and whatever is done to its neighbors":
        "Das Teil bleibt, wie es ist, unabhängig vom Detail und davon, was mit seinen Nachbarn geschieht",
    "Pinned": "Festgepinnt",
    "The part was changed by hand and stays whatever the detail":
        "Das Teil wurde von Hand geändert und bleibt, unabhängig vom Detail",
    "The part is pinned by its lock alone, and was not changed by hand":
        "Das Teil ist nur durch seine Sperre festgepinnt und wurde nicht von Hand geändert",
    "Selected": "Ausgewählt",
    "Included in what is done to the chosen parts": "Gehört zu dem, was mit den gewählten Teilen geschieht",
    "The vertex group made for the part": "Die Punktgruppe, die für das Teil erstellt wurde",
    "The material made for the part": "Das Material, das für das Teil erstellt wurde",
    "The mesh was edited since": "Das Mesh wurde seither bearbeitet",
    "The number of parts decides, not the detail": "Die Anzahl der Teile entscheidet, nicht das Detail",
    "Active Part": "Aktives Teil",
    # Teile verwenden
    "Which parts to use": "Welche Teile verwendet werden",
    "All": "Alle",
    "All parts of the mesh": "Alle Teile des Meshs",
    "Chosen": "Gewählte",
    "The parts marked in the list, or else the active one":
        "Die in der Liste angekreuzten Teile, sonst das aktive",
    "Closed, crosses nothing": "Geschlossen, durchdringt nichts",
    "{n} open {n:edge|edges}": "{n} offene {n:Kante|Kanten}",
    "{n} {n:edge|edges} of three faces": "{n} {n:Kante|Kanten} mit drei Flächen",
    "Faces look both ways at {n} {n:edge|edges}": "Flächen blicken an {n} {n:Kante|Kanten} nach beiden Seiten",
    "{n} {n:face crosses|faces cross} others": "{n} {n:Fläche durchdringt|Flächen durchdringen} andere",
    "Inside out": "Von innen nach außen gekehrt",
    "Thinnest place: {width}": "Dünnste Stelle: {width}",
    "Check the selected separated parts: whether they are closed, cross themselves or are inside out":
        "Die ausgewählten abgetrennten Teile prüfen: ob sie geschlossen sind, sich durchdringen oder umgestülpt sind",
    "Select, in Edit Mode, the faces of the part where something is wrong":
        "Im Bearbeitungsmodus die Flächen des Teils auswählen, an denen etwas nicht stimmt",
    "Kind": "Art",
    "What to select": "Was ausgewählt wird",
    "Open Edges": "Offene Kanten",
    "Faces at edges of one face": "Flächen an Kanten mit nur einer Fläche",
    "Branching Edges": "Verzweigte Kanten",
    "Faces at edges of three faces or more": "Flächen an Kanten mit drei oder mehr Flächen",
    "Faces That Look Both Ways": "Flächen, die nach beiden Seiten blicken",
    "Faces at edges where one looks out and the other in":
        "Flächen an Kanten, an denen eine nach außen und die andere nach innen blickt",
    "Crossing Faces": "Durchdringungen",
    "Faces that cross others": "Flächen, die andere durchdringen",
    "Thinnest Place": "Dünnste Stelle",
    "The face where the part is thinnest": "Die Fläche, an der das Teil am dünnsten ist",
    "Turn faces that look inwards, close holes, and make caps anew that cross something, where that helps":
        "Flächen umdrehen, die nach innen zeigen, Löcher schließen und Deckel neu machen, die etwas durchdringen, wo "
        "das hilft",
    "Where the pieces are cut from each other; the mesh itself stays as it is":
        "Wo die Stücke voneinander getrennt werden; das Mesh selbst bleibt, wie es ist",
    "Along a smooth curve, which lies in a plane where one fits: the faces there are divided in the pieces. Borders "
    "that are smooth already stay as they are":
        "An einer glatten Kurve, die in einer Ebene liegt, wo eine passt: die Flächen dort werden in den Stücken "
        "geteilt. Grenzen, die schon glatt sind, bleiben, wie sie sind",
    "In a plane, the one that fits best, wherever that tears no part; else as Smooth":
        "In der Ebene, die am besten passt, wo immer das keinen Teil zerreißt; sonst wie Glatt",
    "Along the edges of faces, all of which stay whole": "An den Kanten von Flächen, die alle ganz bleiben",
    "Close Holes": "Löcher schließen",
    "Close the holes where parts were joined, so that each piece is closed; borders that the mesh had before stay "
    "open. The faces are marked by the attribute reeb_cap":
        "Die Löcher schließen, wo Teile verbunden waren, sodass jedes Stück geschlossen ist; Ränder, die das Mesh "
        "vorher hatte, bleiben offen. Das Attribut reeb_cap kennzeichnet die neuen Flächen",
    "Cap Material": "Material für Deckel",
    "Give the faces that close holes a material of their own, Cap, which all pieces share; without it, they have that "
    "of the faces beside them":
        "Den Flächen, die Löcher schließen, ein eigenes Material geben, Cap, das alle Stücke gemeinsam haben; sonst "
        "haben sie das der Flächen daneben",
    "Close the holes where parts were joined, so that each file holds a closed body":
        "Die Löcher schließen, wo Teile verbunden waren, sodass jede Datei einen geschlossenen Körper enthält",
    "Origin in the Middle": "Ursprung in die Mitte",
    "Put the origin of each piece to the middle of its surface; without it, all keep the origin of the object":
        "Den Ursprung jedes Stücks in die Mitte seiner Oberfläche setzen; sonst behalten alle den Ursprung des Objekts",
    "Keep Modifiers": "Mit Modifikatoren",
    "Copy the object's modifiers to each piece. Where one works about the origin, as Mirror does, the pieces keep the "
    "origin of the object, so that all stays in its place":
        "Die Modifikatoren des Objekts auf jedes Stück kopieren. Wirkt einer um den Ursprung, wie Spiegeln, behalten "
        "die Stücke den Ursprung des Objekts, damit alles an seinem Platz bleibt",
    "Apply Modifiers": "Modifikatoren anwenden",
    "Cut the mesh as it is seen, with its modifiers applied, instead of the one that is stored; the pieces then have "
    "no modifiers":
        "Das Mesh so schneiden, wie man es sieht, mit angewendeten Modifikatoren, statt so, wie es gespeichert ist; "
        "die Stücke haben dann keine Modifikatoren",
    "The modifiers of {name} make {n} {n:face that belongs|faces that belong} to no part. Apply the modifiers and "
    "decompose again.":
        "Die Modifikatoren von {name} erzeugen {n} {n:Fläche, die zu keinem Teil gehört|Flächen, die zu keinem Teil "
        "gehören}. Bitte die Modifikatoren anwenden und erneut zerlegen.",
    "Parent to Original": "Original als Eltern",
    "Make the pieces children of the object, so that they follow it; without it, they have the parent that the object "
    "has":
        "Die Stücke zu Kindern des Objekts machen, sodass sie ihm folgen; sonst haben sie das Elternobjekt des Objekts",
    "Hide Original": "Original verbergen",
    "Hide the object, which stays as it is, in the viewport and in renders":
        "Das Objekt, das unverändert bleibt, im Ansichtsfenster und beim Rendern verbergen",
    "Where the separated parts are": "Wo die abgetrennten Teile sind",
    "Explode": "Explosion",
    "How far the parts drift apart, as a multiple of their distance from the middle. Only looks so: at 0 the mesh is "
    "as it was. Can be animated":
        "Wie weit die Teile auseinanderrücken, als Vielfaches ihres Abstands von der Mitte. Das sieht nur so aus: bei "
        "0 ist das Mesh wie zuvor. Kann animiert werden",
    # Tooltips der Operatoren
    "Cut the selected mesh into the parts a person would name, and show its Reeb graph":
        "Das ausgewählte Mesh in die Teile zerlegen, die ein Mensch benennen würde, und seinen Reeb-Graphen zeigen",
    "Stop computing; the scene is as it was before": "Die Berechnung beenden; die Szene ist wie zuvor",
    "Remove everything that Reeb Parts has added to the selected meshes; what was there before is back. A UV map that "
    "you have changed or renamed stays, and so do colors that you have painted on, weights of the armature that you "
    "have changed, and the objects made of parts: separated pieces, as your own that do not lead back to the mesh, "
    "hulls and armatures":
        "Alles entfernen, was Reeb Parts den ausgewählten Meshs hinzugefügt hat; was vorher da war, ist wieder da. "
        "Eine UV-Map, die von Hand geändert oder umbenannt wurde, bleibt, ebenso übermalte Farben, von Hand geänderte "
        "Gewichte des Skeletts und aus Teilen erstellte Objekte: abgetrennte Stücke, als eigene, die nicht zum "
        "Mesh zurückführen, Hüllen und Skelette",
    "Set this scene's preset, output and overlay as new scenes have them; see Preferences, Add-ons":
        "Vorgabe, Ausgabe und Überlagerung dieser Szene wie in neuen Szenen setzen; siehe Einstellungen, Add-ons",
    "Set the parameters back to those of the preset; some of them were changed":
        "Die Parameter auf die der Vorgabe zurücksetzen; einige davon wurden geändert",
    "Select the faces of the parts chosen in the list, for Edit Mode":
        "Die Flächen der in der Liste gewählten Teile auswählen, für den Bearbeitungsmodus",
    "Action": "Aktion",
    "Select these faces and no others": "Diese Flächen und keine anderen auswählen",
    "Extend": "Erweitern",
    "Add these faces to the selection": "Diese Flächen der Auswahl hinzufügen",
    "Take these faces from the selection": "Diese Flächen aus der Auswahl nehmen",
    "Part": "Teil",
    "Number of the part; 0 for those chosen in the list": "Nummer des Teils; 0 für die in der Liste gewählten",
    "Hide all faces but those of the chosen parts, or show all again":
        "Alle Flächen außer denen der gewählten Teile verbergen oder alle wieder zeigen",
    "Show All": "Alle zeigen",
    "Show every face again": "Alle Flächen wieder zeigen",
    "Mark parts in the list": "Teile in der Liste ankreuzen",
    "Mark the parts that are like the active one in size, shape and place, on all objects of the scene":
        "Die Teile ankreuzen, die dem aktiven in Größe, Form und Lage ähneln, an allen Objekten der Szene",
    "Difference": "Differenz",
    "All Objects": "Alle Objekte",
    "Name the parts of all decomposed objects, not only of selected ones":
        "Die Teile aller zerlegten Objekte benennen, nicht nur der ausgewählten",
    "How much parts may differ: 0 finds copies only, 1 most parts of a kind":
        "Wie sehr Teile sich unterscheiden dürfen: 0 findet nur Kopien, 1 die meisten Teile einer Art",
    "Give parts of the other selected objects the names of the same parts of the active one, in any pose":
        "Teilen der anderen ausgewählten Objekte die Namen derselben Teile des aktiven geben, in jeder Haltung",
    "Mark every part": "Jedes Teil ankreuzen",
    "None": "Keine",
    "Mark no part": "Kein Teil ankreuzen",
    "Invert": "Invertieren",
    "Mark the parts that are not chosen": "Die Teile ankreuzen, die nicht gewählt sind",
    "Smaller": "Kleinere",
    "Mark the parts smaller than the active one": "Die Teile ankreuzen, die kleiner als das aktive sind",
    "Of Selected Faces": "Ausgewählter Flächen",
    "Mark the parts that have selected faces": "Die Teile ankreuzen, die ausgewählte Flächen haben",
    "Choose parts by clicking on the model or its graph; Shift chooses several":
        "Teile durch Klicken auf das Modell oder seinen Graphen wählen; Umschalt wählt mehrere",
    "A place on or beside the part, in the world": "Eine Stelle auf oder neben dem Teil, in der Welt",
    "On the Graph": "Auf dem Graphen",
    "The location is on an arc of the graph; without it, on the surface":
        "Die Stelle liegt auf einem Bogen des Graphen; sonst auf der Oberfläche",
    "Add the part to those that are chosen, or take it away again":
        "Das Teil zu den gewählten hinzunehmen oder wieder herausnehmen",
    "Number of the part that becomes the active one; 0 for the part at the location":
        "Nummer des Teils, das das aktive wird; 0 für das Teil an der Stelle",
    "Marked": "Angekreuzt",
    "With a number of a part: numbers of the parts that are marked, separated by commas":
        "Zusammen mit der Nummer eines Teils: Nummern der angekreuzten Teile, durch Kommas getrennt",
    "Location": "Position",
    "Make one part of the parts marked in the list; it takes the name of the active one":
        "Aus den in der Liste angekreuzten Teilen eines machen; es erhält den Namen des aktiven",
    "Merge each chosen part into the neighbor that it is least clearly cut from":
        "Jedes gewählte Teil mit dem Nachbarn zusammenführen, von dem es am wenigsten deutlich abgesetzt ist",
    "Split each chosen part in two, where its own best cut is":
        "Jedes gewählte Teil an seinem besten Schnitt in zwei teilen",
    "Cut a part where you click, on the graph or on the surface; a ring shows where the cut will be":
        "Ein Teil dort schneiden, wo geklickt wird, auf dem Graphen oder der Oberfläche; ein Ring zeigt, wo der "
        "Schnitt verlaufen wird",
    "Where to cut, in the world": "Wo geschnitten wird, in der Welt",
    "Slide the boundary of the active part over the surface with the mouse":
        "Die Grenze des aktiven Teils mit der Maus über die Oberfläche schieben",
    "Distance": "Abstand",
    "How far along the surface; negative inwards": "Wie weit entlang der Oberfläche; negativ nach innen",
    "Paint faces of other parts into the active part, with the pointer; locked parts stay":
        "Flächen anderer Teile mit dem Zeiger in das aktive Teil malen; gesperrte Teile bleiben",
    "Radius": "Radius",
    "Of the brush, in the units of the mesh": "Des Pinsels, in den Einheiten des Meshs",
    "Give the faces selected in Edit Mode to the active part":
        "Die im Bearbeitungsmodus ausgewählten Flächen dem aktiven Teil geben",
    "New Part": "Neues Teil",
    "Make a part of its own of the faces": "Aus den Flächen ein eigenes Teil machen",
    "Take over what you have painted with face sets in Sculpt Mode: each face goes to the part of its face set":
        "Übernehmen, was im Skulpturmodus mit Face Sets gemalt wurde: jede Fläche kommt zum Teil ihres Face Sets",
    "Let the detail decide about the chosen parts again, which were changed by hand":
        "Das Detail wieder über die gewählten Teile entscheiden lassen, die von Hand geändert wurden",
    "Release every part that is not locked": "Jedes Teil freigeben, das nicht gesperrt ist",
    "Choose the parts of the selected nodes in the list, and make their object active":
        "Die Teile der ausgewählten Knoten in der Liste wählen und ihr Objekt aktiv machen",
    "Choose the part in which an arc was clicked, and make its object active":
        "Das Teil wählen, in dem ein Bogen angeklickt wurde, und sein Objekt aktiv machen",
    "A place on or beside the arc, in the world": "Eine Stelle auf oder neben dem Bogen, in der Welt",
    "Select the nodes of the chosen parts": "Die Knoten der gewählten Teile auswählen",
    "Split the part that holds the selected node, at the best cut along the node's arcs":
        "Das Teil mit dem ausgewählten Knoten am besten Schnitt entlang der Bögen des Knotens teilen",
    "Make separate objects of the parts, with all that the mesh carries; the original stays as it is":
        "Aus den Teilen eigene Objekte machen, mit allem, was das Mesh trägt; das Original bleibt, wie es ist",
    "Show and select the objects that the selected pieces were separated from, and hide the pieces":
        "Die Objekte zeigen und auswählen, von denen die ausgewählten Stücke abgetrennt wurden, und diese ausblenden",
    "Show and select the pieces that were separated from the selected objects, and hide these":
        "Die Stücke zeigen und auswählen, die von den ausgewählten Objekten abgetrennt wurden, und diese ausblenden",
    "Take Back": "Zurücknehmen",
    "Take them away again; what was there before is back":
        "Sie wieder wegnehmen; was vorher da war, ist wieder da",
    "Mark UV seams where parts meet, beside your own; they follow the parts":
        "UV-Nähte markieren, wo Teile aneinandergrenzen, neben den eigenen; sie folgen den Teilen",
    "Make a face set of each part, for Sculpt Mode; they follow the parts":
        "Aus jedem Teil ein Face Set machen, für den Skulpturmodus; sie folgen den Teilen",
    "Give each part a material of its own, in the part's color; they follow the parts":
        "Jedem Teil ein eigenes Material in seiner Farbe geben; sie folgen den Teilen",
    "Unwrap the mesh along the cuts between parts and your own seams, into a UV map of its own":
        "Das Mesh entlang der Schnitte zwischen Teilen und der eigenen Nähte in eine eigene UV-Map abwickeln",
    "Open Tubes": "Röhren öffnen",
    "Also cut parts open where they would not lie flat: tubes along, and toward tips. These seams run on inner sides "
    "and along creases, and are not marked on the mesh":
        "Auch Teile aufschneiden, wo sie nicht flach lägen: Röhren der Länge nach, und zu Spitzen hin. Diese Nähte "
        "laufen auf den Innenseiten und entlang von Falten und werden auf dem Mesh nicht markiert",
    "Stack Twins": "Zwillinge stapeln",
    "Lay parts whose meshes are mirror images of each other over each other, so that both share one place in the "
    "texture":
        "Teile, deren Meshs Spiegelbilder voneinander sind, übereinander legen, sodass beide einen Platz in der "
        "Textur teilen",
    "Minimum Stretch": "Geringste Dehnung",
    "Areas and angles as even as can be": "Flächen und Winkel so gleichmäßig wie möglich",
    "Angles even, areas less; faster": "Winkel gleichmäßig, Flächen weniger; schneller",
    "The fastest, and the least even": "Am schnellsten und am wenigsten gleichmäßig",
    "How faces are laid flat": "Wie Flächen flach gelegt werden",
    "Angle Based": "Winkelbasiert",
    "Conformal": "Konform",
    "Write each part to a file of its own, or all to one, in a folder; files of the same names are replaced":
        "Jedes Teil in eine eigene Datei schreiben, oder alle in eine, in einem Ordner; Dateien gleichen Namens werden "
        "ersetzt",
    "One File": "Eine Datei",
    "Write all parts of an object to one file, as objects of their own where the format knows objects; 3MF always does":
        "Alle Teile eines Objekts in eine Datei schreiben, als eigene Objekte, wo das Format Objekte kennt; 3MF "
        "immer",
    "For slicers: all parts of an object as one assembly, with names and colors":
        "Für Slicer: alle Teile eines Objekts als eine Baugruppe, mit Namen und Farben",
    "Folder": "Ordner",
    "Where the files go; made if it is not there": "Wohin die Dateien kommen; wird bei Bedarf angelegt",
    "Format": "Format",
    "Kind of the files": "Art der Dateien",
    "OBJ": "OBJ",
    "Wavefront, with materials": "Wavefront, mit Materialien",
    "PLY": "PLY",
    "Stanford, with the colors of the mesh": "Stanford, mit den Farben des Meshes",
    "STL": "STL",
    "For 3D printing": "Für den 3D-Druck",
    "3MF": "3MF",
    "glTF Binary": "glTF Binär",
    "With materials and textures": "Mit Materialien und Texturen",
    "Make an armature that moves the mesh smoothly, with a bone along the center line of each part that can bend":
        "Ein Skelett erstellen, das das Mesh weich bewegt: ein Knochen für jedes Teil, das sich biegen kann, entlang "
        "seiner Mittellinie",
    "Weights": "Gewichtungen",
    "How much each bone moves each vertex; at most four bones move one":
        "Wie sehr jeder Knochen jeden Punkt bewegt; höchstens vier Knochen bewegen einen",
    "Smooth": "Weich",
    "Change smoothly across the cuts, as far as the limb is thick":
        "Ändern sich weich über die Schnitte hinweg, so weit wie das Glied dick ist",
    "Automatic": "Automatisch",
    "Blender's own, by heat from the bones": "Blenders eigene, durch Wärme von den Knochen",
    "Each part moves as a whole, by its own vertex group":
        "Jedes Teil bewegt sich als Ganzes, durch seine eigene Punktgruppe",
    "Blender finds no automatic weights for {name}. Choose smooth weights.":
        "Blender findet keine automatischen Gewichte für {name}. Bitte weiche Gewichte wählen.",
    "{name} shares its mesh, and so its weights, with {other}, which has an armature of its parts. Give {name} a mesh "
    "of its own (Object > Relations > Make Single User > Object & Data) and try again.":
        "{name} teilt das Mesh und damit die Gewichte mit {other}, das ein Skelett seiner Teile hat. Bitte {name} ein "
        "eigenes Mesh geben (Objekt > Beziehungen > Einzelbenutzer erstellen > Objekt & Daten) und erneut versuchen.",
    "{n} {n:part moves with the one it hangs|parts move with the ones they hang} on: no neck to bend at":
        "{n} {n:Teil bewegt sich mit dem, an dem es|Teile bewegen sich mit denen, an denen sie} {n:hängt|hängen}: "
        "kein Hals zum Biegen",
    "Move the Mesh": "Mesh bewegen",
    "Add an Armature modifier, so that posing the bones moves the parts":
        "Einen Skelett-Modifikator hinzufügen, sodass die Posen der Knochen die Teile bewegen",
    "Make convex hulls of each part, of at most 64 corners, with which games and simulations collide":
        "Konvexe Hüllen jedes Teils erstellen, mit höchstens 64 Ecken, für Kollisionen in Spielen und Simulationen",
    "Hulls per Part": "Hüllen je Teil",
    "How many hulls a part has at most; a part that one hull fits well has one":
        "Wie viele Hüllen ein Teil höchstens hat; ein Teil, zu dem eine Hülle gut passt, hat eine",
    "Make rigid bodies of the separated parts, held together at the cuts; press Play to see them fall":
        "Starrkörper aus den abgetrennten Teilen erstellen, die an den Schnitten zusammenhalten; Abspielen lässt sie "
        "fallen",
    "Joints": "Gelenke",
    "How parts hold together at the cuts": "Wie Teile an den Schnitten zusammenhalten",
    "Hinges": "Scharniere",
    "Bend about the longest line of the cut": "Biegen sich um die längste Linie des Schnitts",
    "Points": "Punkte",
    "Turn in every direction about the middle of the cut": "Drehen sich in jede Richtung um die Mitte des Schnitts",
    "Fixed": "Fixiert",
    "Do not move": "Bewegen sich nicht",
    "{n} {n:rigid body|rigid bodies}, {total} {total:joint|joints}":
        "{n} {n:Starrkörper|Starrkörper}, {total} {total:Gelenk|Gelenke}",
    "Names": "Namen",
    "How the hulls are called, so that the game engine finds them":
        "Wie die Hüllen heißen, damit die Engine sie findet",
    "Unreal": "Unreal",
    "UCX_, the object and a number": "UCX_, das Objekt und eine Nummer",
    "Godot": "Godot",
    "The part, then -convcolonly": "Das Teil, dann -convcolonly",
    # Verbindungen zum Drucken
    "No joints; Close Holes decides whether pieces are closed":
        "Keine Verbindungen; „Löcher schließen“ entscheidet, ob die Stücke geschlossen sind",
    "The smaller piece has a round peg, the other a hole for it":
        "Das kleinere Stück hat einen runden Zapfen, das andere ein Loch dafür",
    "Pegs that do not turn in their holes": "Zapfen, die sich in ihren Löchern nicht drehen",
    "Pegs like the tail of a dove, which fit into their holes one way round only":
        "Zapfen wie ein Schwalbenschwanz, die nur in einer Lage in ihre Löcher passen",
    "Both pieces have a hole, and a loose dowel goes into both":
        "Beide Stücke haben ein Loch, und ein loser Dübel steckt in beiden",
    "Both pieces have a round hole for a magnet, as deep as Depth says":
        "Beide Stücke haben ein rundes Loch für einen Magneten, so tief, wie es die Tiefe sagt",
    "What joins the pieces when they are printed, along the axis of each cut; holes are closed then. "
    "A cut without room for it stays without":
        "Was die Stücke verbindet, wenn sie gedruckt sind, entlang der Achse jedes Schnitts; Löcher werden dann "
        "geschlossen. Ein Schnitt ohne Platz dafür bleibt ohne",
    "Per Cut": "Je Schnitt",
    "How many joints a cut gets where there is room for them; two or more keep pieces from turning":
        "Wie viele Verbindungen ein Schnitt bekommt, wo Platz ist; zwei oder mehr verhindern, dass sich Stücke drehen",
    "Width (mm)": "Breite (mm)",
    "Width of the joints in millimeters; 0 for a third of each cut's. Where there is no room, they are smaller":
        "Breite der Verbindungen in Millimetern; 0 für ein Drittel der Breite jedes Schnitts. Wo kein Platz ist, sind "
        "sie kleiner",
    "Depth (mm)": "Tiefe (mm)",
    "How deep joints go into a piece, in millimeters; 0 for what suits their width":
        "Wie tief Verbindungen in ein Stück reichen, in Millimetern; 0 für das, was zu ihrer Breite passt",
    "Clearance (mm)": "Spiel (mm)",
    "Gap between a joint and its hole all around, in millimeters":
        "Abstand zwischen einer Verbindung und ihrem Loch ringsum, in Millimetern",
    "Wall (mm)": "Wand (mm)",
    "The least thickness of what remains around a joint, in millimeters; at least a third of its radius":
        "Wie dick mindestens ist, was um eine Verbindung herum bleibt, in Millimetern; wenigstens ein Drittel ihres "
        "Radius",
    "{n} of {total} {total:cut has|cuts have} joints":
        "{n} von {total} {total:Schnitt|Schnitten} {n:hat|haben} Verbindungen",
    "No joint where there is no room for one with a wall around it: {cuts}":
        "Keine Verbindung, wo kein Platz für eine mit einer Wand ringsum ist: {cuts}",
    "No joint where a cut is so bent that it has no axis: {cuts}":
        "Keine Verbindung, wo ein Schnitt so gebogen ist, dass er keine Achse hat: {cuts}",
    "No joint where a part is not closed or crosses itself: {cuts}":
        "Keine Verbindung, wo ein Teil nicht geschlossen ist oder sich durchdringt: {cuts}",
    "No joint where it would have left a part open or pierced: {cuts}":
        "Keine Verbindung, wo sie ein Teil geöffnet oder durchstoßen hätte: {cuts}",
    "What Joints says": "Was unter Verbindungen steht",
    "What joins these two pieces when the parts are separated the next time":
        "Was diese beiden Stücke verbindet, wenn die Teile das nächste Mal getrennt werden",
    "{n} {n:joint|joints}, {width} mm wide": "{n} {n:Verbindung|Verbindungen}, {width} mm breit",
    "Fit the Bed": "Passend zum Druckbett",
    "Cut parts that are longer than the printer's bed further, in planes across them":
        "Teile, die länger als das Bett des Druckers sind, weiter schneiden, in Ebenen quer durch sie",
    "Bed (mm)": "Druckbett (mm)",
    "Width, depth and height that can be printed, in millimeters; pieces may be turned to fit":
        "Breite, Tiefe und Höhe, die gedruckt werden können, in Millimetern; Stücke dürfen dafür gedreht werden",
    "{n} more {n:piece|pieces}, so that all fit the bed": "{n} {n:Stück|Stücke} mehr, damit alle ins Druckbett passen",
    "Not closed, so not cut to fit the bed: {names}":
        "Nicht geschlossen und darum nicht für das Druckbett geschnitten: {names}",
    "Separated Pieces": "Abgetrennte Stücke",
    "Write the pieces that were separated, with their joints and dowels, as they are now":
        "Die abgetrennten Stücke schreiben, mit ihren Verbindungen und Dübeln, wie sie jetzt sind",
    "There are no separated parts of {name}. Separate them first.":
        "Es gibt keine abgetrennten Teile von {name}. Bitte zuerst trennen.",
    "No room with a wall around it": "Kein Platz mit einer Wand ringsum",
    "Too bent to have an axis": "Zu gebogen für eine Achse",
    "A part is not closed": "Ein Teil ist nicht geschlossen",
    "It would spoil a part": "Ein Teil würde beschädigt",
    "There would be more than {n} pieces. Is the bed in millimeters?":
        "Es würden mehr als {n} Stücke. Ist das Druckbett in Millimetern angegeben?",
    # Was über ein Mesh zu sagen ist
    "{n} {n:edge joins|edges join} more than two faces (non-manifold).":
        "Kanten mit mehr als zwei Flächen (nicht mannigfaltig): {n}.",
    "{n} {n:face lies|faces lie} on another one with the same corners, and {n:has|have} its part.":
        "Flächen, die auf einer anderen mit denselben Ecken liegen und deren Teil haben: {n}.",
    "{n} {n:face lies|faces lie} within the solid, in its plane of symmetry, and {n:has|have} "
    "the parts of what is nearest.":
        "Flächen, die im Inneren des Körpers in seiner Symmetrieebene liegen und die Teile des Nächstgelegenen haben: "
        "{n}.",
    "{n} {n:face runs|faces run} along others as a second skin, such as an outline or an inner wall, and "
    "{n:has|have} their parts.":
        "Flächen, die als zweite Haut, etwa als Kontur oder Innenwand, an anderen entlanglaufen und deren Teile "
        "haben: {n}.",
    "{n} border {n:edge|edges}: the surface is open there.": "Randkanten: {n}; dort ist die Oberfläche offen.",
    "{n} {n:vertex belongs to no face; it gets|vertices belong to no face; they get} no part.":
        "Punkte ohne Fläche: {n}; sie kommen in kein Teil.",
    "{n} {n:face has zero area; it follows its|faces have zero area; they follow their} neighbors.":
        "Flächen ohne Flächeninhalt: {n}; sie folgen ihren Nachbarn.",
    "{asked} parts were asked for; there are {n} at most.":
        "{asked} Teile wurden verlangt; es gibt höchstens {n}.",
    "{n} coincident border {n:vertex is|vertices are} treated as joined.":
        "Zusammenfallende Randpunkte: {n}; sie gelten als verbunden.",
    "{n} faces whose borders run along each other, but do not meet, are treated as joined.":
        "Flächen, deren Ränder aneinander entlanglaufen, sich aber nicht treffen: {n}; sie gelten als verbunden.",
    "{n} {n:triangle faces inwards or against its|triangles face inwards or against their} neighbors.":
        "Dreiecke, die nach innen oder gegen ihre Nachbarn zeigen: {n}.",
    "{type} is no mesh: give vertices and faces.": "{type} ist kein Mesh: nötig sind vertices und faces.",
    "{n} {n:number is|numbers are} masked. Leave out the vertices and faces that have them.":
        "Maskierte Zahlen: {n}. Lassen Sie die Punkte und Flächen weg, zu denen sie gehören.",
    "{n} pieces that touch, or nearly so, form one body; with Pieces: Separate each is decomposed on its own.":
        "{n} Stücke, die sich (fast) berühren, bilden einen Körper; mit Stücke: Getrennt wird jedes für sich zerlegt.",
    "{n} pieces form {bodies} bodies; what touches is decomposed together.":
        "{n} Stücke bilden {bodies} Körper; was sich berührt, wird gemeinsam zerlegt.",
    "The rest is decomposed without {n} large plain {n:piece|pieces}, such as a floor.":
        "Große schlichte Stücke wie ein Boden ({n}) bleiben außen vor; der Rest wird ohne sie zerlegt.",
    "{n} small {n:body is one part|bodies are one part each}.": "Kleine Körper, die je ein einziges Teil sind: {n}.",
    "{n} of the bodies {n:is|are} so even that nothing protrudes.":
        "Körper, die so gleichmäßig sind, dass nichts vorsteht: {n}.",
    "{n} loose parts are decomposed each on its own.": "{n} lose Teile werden jedes für sich zerlegt.",
    "{n} loose parts are decomposed each on its own; {small} small {small:one is one|ones are one} part each.":
        "{n} lose Teile werden jedes für sich zerlegt; davon sind klein und je ein einziges Teil: {small}.",
    "{n} of the loose parts {n:is|are} so even that nothing protrudes.":
        "Lose Teile, die so gleichmäßig sind, dass nichts vorsteht: {n}.",
    "Nothing protrudes: the surface is even.": "Nichts steht vor: die Oberfläche ist gleichmäßig.",
    "The mesh was decomposed together with its mirror image.":
        "Das Mesh wurde zusammen mit seinem Spiegelbild zerlegt.",
    "A mirror plane is four numbers: its normal, and its distance from the origin.":
        "Eine Spiegelebene sind vier Zahlen: ihre Normale und ihr Abstand vom Ursprung.",
    "Faces that a Boolean modifier adds to {name} are in no part and have no color.":
        "Flächen, die ein Boolesch-Modifikator zu {name} hinzufügt, sind in keinem Teil und haben keine Farbe.",
    "No joints: there is no cut that could have one.":
        "Keine Verbindungen: Es gibt keinen Schnitt, der welche haben könnte.",
    "{name} was decomposed as it is before its modifier was applied.":
        "{name} wurde zerlegt, wie es vor Anwendung seines Modifikators ist.",
    "{name} was decomposed as it is before its {n} modifiers were applied.":
        "{name} wurde zerlegt, wie es vor Anwendung seiner {n} Modifikatoren ist.",
    "{n} objects share this mesh; all of them show its parts.":
        "{n} Objekte teilen sich dieses Mesh; alle zeigen seine Teile.",
    # Was nicht zerlegt werden kann
    "Select a mesh first": "Zuerst ein Mesh auswählen",
    "There is no active object. Select a mesh and try again.":
        "Es gibt kein aktives Objekt. Bitte ein Mesh auswählen und erneut versuchen.",
    "{name} is the active object, and not a mesh. Hold Shift and click the mesh.":
        "{name} ist das aktive Objekt und kein Mesh. Bitte bei gedrückter Umschalttaste auf das Mesh klicken.",
    "{name} is not a mesh but of the type {kind}. Select a mesh and try again.":
        "{name} ist kein Mesh, sondern vom Typ {kind}. Bitte ein Mesh auswählen und erneut versuchen.",
    "{name} is not a mesh but of the type {kind}. Convert it (Object > Convert > Mesh) and try again.":
        "{name} ist kein Mesh, sondern vom Typ {kind}. Bitte umwandeln (Objekt > Konvertieren > Mesh) und erneut "
        "versuchen.",
    "The faces of {name} are made by its modifiers. Apply these (Object > Convert > Mesh) and try again.":
        "Die Flächen von {name} stammen von seinen Modifikatoren. Bitte anwenden (Objekt > Konvertieren > Mesh) und "
        "erneut versuchen.",
    "{name} is a library override and its mesh cannot be written. Make it local (Object > Library Override > Make "
    "Local) and try again.":
        "{name} ist eine Bibliotheksüberschreibung, ihr Mesh kann nicht geändert werden. Bitte lokal machen (Objekt > "
        "Bibliotheksüberschreibung > Lokal machen) und erneut versuchen.",
    "{name} is linked from {source}, which is not there or does not have it any more. Bring it back and open the file "
    "again.":
        "{name} ist aus {source} verknüpft, was nicht da ist oder es nicht mehr enthält. Bitte zurückholen und die "
        "Datei noch einmal öffnen.",
    "{name} is linked from {source} and cannot be written. Make it local (Object > Relations > Make Local) and try "
    "again.":
        "{name} ist aus {source} verknüpft und kann nicht geändert werden. Bitte lokal machen (Objekt > Beziehungen > "
        "Lokal machen) und erneut versuchen.",
    "another file": "einer anderen Datei",
    "The mesh of {name} is being edited through another object. Leave Edit Mode there first.":
        "Das Mesh von {name} wird über ein anderes Objekt bearbeitet. Bitte dort zuerst den Bearbeitungsmodus "
        "verlassen.",
    "{name} is being sculpted with dynamic topology, which keeps its own mesh. Switch Dyntopo off, or leave Sculpt "
    "Mode, and try again.":
        "{name} wird mit dynamischer Topologie geformt, die ihr eigenes Mesh hat. Bitte Dyntopo ausschalten oder den "
        "Skulpturmodus verlassen und erneut versuchen.",
    "The mesh has no faces. Add some, or choose another object.":
        "Das Mesh hat keine Flächen. Bitte welche hinzufügen oder ein anderes Objekt wählen.",
    "The mesh has only {n} of the {least} faces that the smallest solid has. Choose a larger mesh.":
        "Das Mesh hat nur {n} der {least} Flächen, die der kleinste Körper hat. Bitte ein größeres Mesh wählen.",
    "All {n} faces have zero area. Check the scale of the object.":
        "Alle {n} Flächen haben den Flächeninhalt null. Bitte die Skalierung des Objekts prüfen.",
    "{n} of {total} vertices {n:has|have} a coordinate that is not a finite number (first: vertex {first}). Delete or "
    "move them.":
        "{n} von {total} Punkten {n:hat|haben} eine Koordinate, die keine endliche Zahl ist (zuerst Punkt {first}). "
        "Bitte "
        "löschen oder verschieben.",
    "{n} of {total} faces {n:names|name} a vertex that does not exist (first: face {first}; there are {n_vertices} "
    "vertices).":
        "{n} von {total} Flächen {n:nennt|nennen} einen Punkt, den es nicht gibt (zuerst Fläche {first}; es gibt "
        "{n_vertices} "
        "Punkte).",
    "{n} {n:face has|faces have} fewer than three corners.": "{n} {n:Fläche hat|Flächen haben} weniger als drei Ecken.",
    "{n} {n:vertex|vertices} cannot be reached from vertex {source}.":
        "{n} {n:Punkt ist|Punkte sind} von Punkt {source} aus nicht erreichbar.",
    "Vertices must have shape (n, 3), not {shape}.": "Punkte müssen die Form (n, 3) haben, nicht {shape}.",
    "Triangles must have shape (m, 3), not {shape}.": "Dreiecke müssen die Form (m, 3) haben, nicht {shape}.",
    "Labels must be a row of whole numbers, at least one, not {type} of shape {shape}.":
        "Kennzahlen müssen eine Reihe ganzer Zahlen sein, mindestens eine, nicht {type} der Form {shape}.",
    "There are {n} values for {total} elements: each needs one.":
        "Es gibt {n} Werte für {total} Elemente: Jedes braucht einen.",
    "There are {n} {name} for {total} parts: each part needs one.":
        "Es gibt {n} {name} für {total} Teile: Jedes Teil braucht einen Wert.",
    "The parts are of another mesh: give the one that was decomposed.":
        "Die Teile gehören zu einem anderen Mesh: Nötig ist das, das zerlegt wurde.",
    "{name} must be {wanted}, not {type}.":
        "{name} muss {wanted} sein, nicht {type}.",
    "{name} must have {n} numbers for each part, as descriptors do.":
        "{name} muss {n} Zahlen für jedes Teil haben, wie Deskriptoren.",
    "Neighbors must be pairs of whole numbers from 0 to {last}.":
        "Nachbarn müssen Paare ganzer Zahlen von 0 bis {last} sein.",
    "The parts are of another result: give the one that they were read from.":
        "Die Teile gehören zu einem anderen Ergebnis: Nötig ist das, aus dem sie gelesen wurden.",
    "{name} must be finite numbers of shape {shape}, not {given}.":
        "{name} müssen endliche Zahlen der Form {shape} sein, nicht {given}.",
    "Weights must be 0 or more, finite, and not all of them 0.":
        "Gewichte müssen 0 oder mehr und endlich sein, und nicht alle 0.",
    "Faces must have shape (m, corners), not {shape}.": "Flächen müssen die Form (m, Ecken) haben, nicht {shape}.",
    "Face indices must be whole numbers, not {type}.": "Flächenindizes müssen ganze Zahlen sein, nicht {type}.",
    "Labels must be {n} whole numbers from 0, one for each face.":
        "Kennzahlen müssen {n} ganze Zahlen ab 0 sein, eine für jede Fläche.",
    "Groups must be {n} whole numbers, one for each candidate.":
        "Gruppen müssen {n} ganze Zahlen sein, eine für jeden Kandidaten.",
    "Numbers must be {n} whole numbers from 1, one for each part.":
        "Nummern müssen {n} ganze Zahlen ab 1 sein, eine für jedes Teil.",
    "Colors must be from 0 to 1.": "Farben müssen von 0 bis 1 sein.",
    "Polygon numbers must be {n} whole numbers from 0, one per triangle.":
        "Polygonnummern müssen {n} ganze Zahlen ab 0 sein, eine je Dreieck.",
    "{name} must be one of {choices}, not {value}.": "{name} muss eines von {choices} sein, nicht {value}.",
    "{name} must be a number, not {value}.": "{name} muss eine Zahl sein, nicht {value}.",
    "{name} must be a number from {low} to {high}, not {value}.":
        "{name} muss eine Zahl von {low} bis {high} sein, nicht {value}.",
    "{name} must be a whole number from {low} to {high}, not {value}.":
        "{name} muss eine ganze Zahl von {low} bis {high} sein, nicht {value}.",
    "The mesh is too large to be measured. Check the scale of the object.":
        "Das Mesh ist zu groß, um es zu messen. Bitte die Skalierung des Objekts prüfen.",
    "The stored parts are damaged. Decompose again.":
        "Die gespeicherten Teile sind beschädigt. Bitte erneut zerlegen.",
    "The stored parts were written by Reeb Parts {version}, which is newer than this one. Install that version, or "
    "decompose again.":
        "Die gespeicherten Teile stammen von Reeb Parts {version}, das neuer ist als dieses. Bitte diese Version "
        "installieren oder erneut zerlegen.",
    "{name} must be true or false, not {value}.": "{name} muss wahr oder falsch sein, nicht {value}.",
    "There is no parameter {name}.": "Es gibt keinen Parameter {name}.",
    "Parameters are given by their names, not as {value}.":
        "Parameter werden mit ihren Namen angegeben, nicht als {value}.",
    "Vertices must be rows of three numbers.": "Vertices müssen Zeilen aus drei Zahlen sein.",
    "{n} {n:face is no row|faces are no rows} of whole numbers (first: face {first}).":
        "{n} {n:Fläche ist keine Zeile|Flächen sind keine Zeilen} ganzer Zahlen (die erste: Fläche {first}).",
    "There is no preset {name}. Choose one of: {presets}.":
        "Es gibt keine Vorgabe {name}. Bitte eine von diesen wählen: {presets}.",
    "SciPy, which Reeb Parts computes with, could not be imported ({error}). Install Reeb Parts again; if that does "
    "not help, another extension brings a SciPy that does not fit this Blender.":
        "SciPy, womit Reeb Parts rechnet, konnte nicht importiert werden ({error}). Bitte Reeb Parts neu installieren; "
        "hilft das nicht, bringt eine andere Erweiterung ein SciPy mit, das nicht zu diesem Blender passt.",
    # Was aus dem Zerlegen wurde
    "Reeb Parts is still computing": "Reeb Parts rechnet noch",
    "{n} {n:part|parts} in {seconds:.1f} s": "{n} {n:Teil|Teile} in {seconds:.1f} s",
    "Blender stood still, since its Python could not be started beside it":
        "Blender stand still, weil sein Python nicht daneben gestartet werden konnte",
    "There is not enough memory to decompose {name} ({n} vertices); nothing was changed. Close other programs, or "
    "decimate a copy and decompose that.":
        "Der Speicher reicht nicht, um {name} zu zerlegen ({n} Punkte); nichts wurde geändert. Bitte andere Programme "
        "schließen, oder eine Kopie dezimieren und diese zerlegen.",
    "There is not enough memory; nothing was changed. Close other programs and try again.":
        "Der Speicher reicht nicht; nichts wurde geändert. Bitte andere Programme schließen und es noch einmal "
        "versuchen.",
    "The process that decomposed {name} ended unexpectedly ({reason}); nothing was changed. Try again, and report it "
    "if that happens again.":
        "Der Prozess, der {name} zerlegte, endete unerwartet ({reason}); nichts wurde geändert. Bitte noch einmal "
        "versuchen, und es melden, wenn das wieder geschieht.",
    "Cancelled; nothing was changed": "Abgebrochen; nichts wurde geändert",
    "{command} was ended with its window; nothing was changed.":
        "{command} wurde mit seinem Fenster beendet; nichts wurde geändert.",
    "What was worked on has been deleted meanwhile; nothing was made.":
        "Woran gearbeitet wurde, ist inzwischen gelöscht worden; nichts wurde gemacht.",
    "{name} is gone; its parts were computed in vain.":
        "{name} ist nicht mehr da; seine Teile wurden vergeblich berechnet.",
    "{name} is not in this scene. Go back to its own, and decompose it again.":
        "{name} ist nicht in dieser Szene. Bitte in der eigenen erneut zerlegen.",
    "{name} was changed while its parts were computed. Decompose it again.":
        "{name} wurde geändert, während seine Teile berechnet wurden. Bitte erneut zerlegen.",
    "The active object has no parts": "Das aktive Objekt hat keine Teile",
    "Decompose the mesh first": "Das Mesh zuerst zerlegen",
    "Select the original, {name}, first.": "Bitte zuerst das Original auswählen, {name}.",
    "{name} has no parts yet. Decompose it first.": "{name} hat noch keine Teile. Bitte zuerst zerlegen.",
    "{name} is being edited. Leave Edit Mode first.":
        "{name} wird gerade bearbeitet. Bitte zuerst den Bearbeitungsmodus verlassen.",
    "{name} was edited since it was decomposed. Decompose it again.":
        "{name} wurde seit dem Zerlegen bearbeitet. Bitte erneut zerlegen.",
    "The stored parts were written by another version. Decompose again.":
        "Die gespeicherten Teile stammen von einer anderen Version. Bitte erneut zerlegen.",
    # Was die Werkzeuge melden
    "There is no part with the number {number}.": "Es gibt kein Teil mit der Nummer {number}.",
    "No other part is like {name}; a larger difference finds more":
        "Kein anderes Teil ist wie {name}; eine größere Differenz findet mehr",
    "Similar parts: {n}, marked on {objects} {objects:object|objects}":
        "Ähnliche Teile: {n}, angekreuzt an {objects} {objects:Objekt|Objekten}",
    "Parts named: {n}, on {objects} {objects:object|objects}":
        "Benannte Teile: {n}, an {objects} {objects:Objekt|Objekten}",
    "No part of {name} has a name of its own. Double-click parts in the list to name them.":
        "Kein Teil von {name} hat einen eigenen Namen. Ein Doppelklick auf ein Teil der Liste benennt es.",
    "Select other decomposed objects, too; the active one gives the names.":
        "Bitte auch andere zerlegte Objekte auswählen; das aktive gibt die Namen.",
    "{name} is locked. Unlock it in the list first.": "{name} ist gesperrt. Bitte zuerst in der Liste entsperren.",
    "Mark the parts to merge in the list, two or more.":
        "Bitte die Teile in der Liste ankreuzen, die zusammengeführt werden sollen, mindestens zwei.",
    "These parts do not touch each other. Choose parts that do.":
        "Diese Teile berühren einander nicht. Bitte Teile wählen, die es tun.",
    "{n} {n:part is|parts are} {name} now": "{n} {n:Teil ist|Teile sind} jetzt {name}",
    "{name} shares no edge with another part: there is no boundary to move.":
        "{name} hat mit keinem anderen Teil eine Kante gemeinsam: keine Grenze zu verschieben.",
    "{name} touches no other part.": "{name} berührt kein anderes Teil.",
    "No cut was found inside {name}. Select faces in Edit Mode and assign them to another part instead.":
        "In {name} wurde kein Schnitt gefunden. Stattdessen können im Bearbeitungsmodus Flächen ausgewählt und einem "
        "anderen Teil zugewiesen werden.",
    "{new} was cut from {name}": "{new} wurde von {name} abgeschnitten",
    "Nothing of {name} would be cut off there. Point at another place.":
        "Dort würde von {name} nichts abgeschnitten. Bitte auf eine andere Stelle zeigen.",
    "Nothing is left around {name} that is not locked.": "Um {name} ist nichts mehr, was nicht gesperrt ist.",
    "Nothing is left around {name} that it could take.": "Um {name} ist nichts mehr, was dazugenommen werden könnte.",
    "{name} cannot give away anything more.": "{name} kann nichts mehr abgeben.",
    "Nothing would be left of the part. Slide the boundary less far.":
        "Von dem Teil bliebe nichts übrig. Bitte die Grenze weniger weit verschieben.",
    "Drag over the model to paint    Ctrl and wheel, [ ]: size    Enter: confirm    Esc: cancel":
        "Zum Malen über das Modell ziehen    Strg und Mausrad, [ ]: Größe    Eingabe: bestätigen    Esc: abbrechen",
    "Click the graph or the surface to cut the part there    Enter, Esc: end":
        "Auf den Graphen oder die Oberfläche klicken, um das Teil dort zu schneiden    Eingabe, Esc: beenden",
    "Click a part or the graph to choose it    Shift: several    Enter, Esc: end":
        "Auf ein Teil oder den Graphen klicken, um es zu wählen    Umschalt: mehrere    Eingabe, Esc: beenden",
    "This works in Object Mode, where the parts can be seen.":
        "Das geht im Objektmodus, wo die Teile zu sehen sind.",
    "This works over a 3D viewport.": "Das geht über einem 3D-Ansichtsfenster.",
    "The object was changed meanwhile.": "Das Objekt wurde inzwischen geändert.",
    "No faces were painted.": "Es wurden keine Flächen gemalt.",
    "No faces are selected. Select some in Edit Mode.":
        "Es sind keine Flächen ausgewählt. Bitte im Bearbeitungsmodus welche auswählen.",
    "{n} {n:face is|faces are} {name} now": "{n} {n:Fläche ist|Flächen sind} jetzt {name}",
    "{n} {n:face is in another part|faces are in other parts} now":
        "{n} {n:Fläche ist jetzt in einem anderen Teil|Flächen sind jetzt in anderen Teilen}",
    "The parts are not face sets yet. Press Face Sets, then paint them in Sculpt Mode.":
        "Die Teile sind noch keine Face Sets. Bitte auf Face Sets drücken, dann im Skulpturmodus malen.",
    "Select a node of a graph": "Einen Knoten eines Graphen auswählen",
    "Select the arcs of a graph": "Die Bögen eines Graphen auswählen",
    "The active object shows no graph": "Das aktive Objekt zeigt keinen Graphen",
    "Leave the object's mode first": "Zuerst den Modus des Objekts verlassen",
    "Nothing is being computed": "Es wird nichts berechnet",
    "Go to Object Mode first": "Zuerst in den Objektmodus wechseln",
    "{name}: {n} {n:part is an object|parts are objects} now":
        "{name}: {n} {n:Teil ist jetzt ein Objekt|Teile sind jetzt Objekte}",
    "{n} earlier {n:object that was edited or is needed by others is left as it is|objects that were edited or are "
    "needed by others are left as they are}":
        "{n} {n:früheres Objekt, das bearbeitet wurde oder das andere brauchen, bleibt, wie es ist|frühere Objekte, "
        "die bearbeitet wurden oder die andere brauchen, bleiben, wie sie sind}",
    "{n} of {total} {total:part|parts} {n:is not closed or crosses itself|are not closed or cross themselves}: {names}":
        "{n} von {total} {total:Teil|Teilen} {n:ist nicht geschlossen oder durchdringt|sind nicht geschlossen oder "
        "durchdringen} sich: {names}",
    "{n} of {total} {total:part|parts} {n:has|have} faces that look inwards: {names}":
        "{n} von {total} {total:Teil|Teilen} {n:hat|haben} Flächen, die nach innen blicken: {names}",
    "{name} is missing from renders of other scenes: {names}":
        "{name} fehlt beim Rendern in anderen Szenen: {names}",
    "{name} is missing from renders of instances of its collection: {names}":
        "{name} fehlt beim Rendern in Instanzen der eigenen Sammlung: {names}",
    "{n} of {total} {total:part|parts} {n:is open or crosses itself|are open or cross themselves} as the model does "
    "there: {names}":
        "{n} von {total} {total:Teil|Teilen} {n:ist offen oder durchdringt|sind offen oder durchdringen} sich, wie das "
        "Modell es dort tut: {names}",
    "{n} {n:part is closed and does not cross itself|parts are closed and do not cross themselves}":
        "{n} {n:Teil ist geschlossen und durchdringt|Teile sind geschlossen und durchdringen} sich nicht",
    "{name} has nothing of the kind.": "{name} hat nichts dergleichen.",
    "{n} {n:face|faces} selected": "{n} {n:Fläche|Flächen} ausgewählt",
    "Other objects share the mesh of {name}": "Andere Objekte teilen sich das Mesh von {name}",
    "Nothing has to be repaired": "Es gibt nichts zu reparieren",
    "Nothing of {name} can be repaired": "An {name} lässt sich nichts reparieren",
    "{n} {n:border runs|borders run} along faces: a smooth cut would tear or cross a part there":
        "{n} {n:Grenze verläuft|Grenzen verlaufen} an Flächen: ein glatter Schnitt würde dort ein Teil zerreißen oder "
        "durchdringen",
    "{n} {n:edge stays|edges stay} open: more than two faces meet beside {n:it|them}":
        "{n} {n:Kante bleibt|Kanten bleiben} offen: neben {n:ihr|ihnen} treffen mehr als zwei Flächen zusammen",
    "{name} is in another mode than the active object. Go to Object Mode there first.":
        "{name} ist in einem anderen Modus als das aktive Objekt. Bitte dort zuerst in den Objektmodus gehen.",
    "The modifiers of {name} leave no faces, though perhaps instances. Apply them as a mesh and decompose again.":
        "Die Modifikatoren von {name} lassen keine Flächen übrig, vielleicht aber Instanzen. Bitte als Mesh anwenden "
        "und erneut zerlegen.",
    "{name} is not in this view layer. Include its collection first.":
        "{name} ist nicht in dieser Ansichtsebene. Bitte zuerst seine Sammlung einschließen.",
    "The effect of {modifiers} is made for all of {name}, and each part takes another shape: use Apply "
    "Modifiers to keep the shape":
        "Die Wirkung von {modifiers} gilt dem ganzen {name}, und jedes Teil bekommt eine andere Form: mit "
        "„Modifikatoren anwenden“ bleibt die Form",
    "The effect of {modifiers} depends on the extent of the mesh, which differs for each part of {name}: use Apply "
    "Modifiers to keep the shape":
        "Die Wirkung von {modifiers} hängt von der Ausdehnung des Meshs ab, die für jedes Teil von {name} eine andere "
        "ist: mit „Modifikatoren anwenden“ bleibt die Form",
    "{n} border {n:vertex lies on another one but cannot be joined with it|vertices lie on others but cannot be joined "
    "with them}: parts stay open there":
        "{n} {n:Randpunkt liegt auf einem anderen, ist aber nicht mit ihm zu verbinden|Randpunkte liegen auf anderen, "
        "sind aber nicht mit ihnen zu verbinden}: dort bleiben Teile offen",
    "The active object is not a part that was separated from another one":
        "Das aktive Objekt ist kein Teil, das von einem anderen abgetrennt wurde",
    "The object that {name} was separated from is not in this file.":
        "Das Objekt, von dem {name} abgetrennt wurde, ist nicht in dieser Datei.",
    "Seams around {n} {n:part|parts}": "Nähte um {n} {n:Teil|Teile}",
    "The seams are yours alone again": "Es sind wieder nur die eigenen Nähte da",
    "{n} {n:part is a face set|parts are face sets}": "{n} {n:Teil ist ein Face Set|Teile sind Face Sets}",
    "The face sets are yours alone again": "Es sind wieder nur die eigenen Face Sets da",
    "{n} {n:part has a material|parts have materials}": "{n} {n:Teil hat ein Material|Teile haben Materialien}",
    "The materials are yours alone again": "Es sind wieder nur die eigenen Materialien da",
    "The location is not finite. Give one on or beside the model.":
        "Der Ort ist nicht endlich. Bitte einen auf oder neben dem Modell angeben.",
    "{name} has as many UV maps as Blender allows. Remove one and try again.":
        "{name} hat so viele UV-Maps, wie Blender erlaubt. Bitte eine entfernen und erneut versuchen.",
    "{name}: the UV map {map} was changed by hand and stays":
        "{name}: Die UV-Map {map} wurde von Hand geändert und bleibt",
    "{name}: the colors {attribute} were painted on and stay":
        "{name}: Die Farben {attribute} wurden übermalt und bleiben",
    "{name}: weights of the armature were changed by hand and stay":
        "{name}: Gewichte des Skeletts wurden von Hand geändert und bleiben",
    "Unwrapped into the UV map {name}: areas {low:.1f} to {high:.1f} times their size, {share:.0%} of the faces within "
    "0.3 to 3; angles {angle:.0f}° off on average":
        "In die UV-Map {name} abgewickelt: Flächen auf das {low:.1f}- bis {high:.1f}-Fache, {share:.0%} davon "
        "zwischen 0.3 und 3; Winkel im Mittel um {angle:.0f}° verändert",
    "{n} {n:face is|faces are} mirrored in the UV map":
        "{n} {n:Fläche ist|Flächen sind} in der UV-Map gespiegelt",
    "{n} {n:hull|hulls}": "{n} {n:Hülle|Hüllen}",
    "There is no folder to write to. Choose one and try again.":
        "Es ist kein Ordner angegeben. Bitte einen wählen und erneut versuchen.",
    "{path} could not be written: {reason}": "{path} konnte nicht geschrieben werden: {reason}",
    "{path} could not be written: Blender takes names of up to {n} bytes, with all folders.":
        "{path} konnte nicht geschrieben werden: Blender nimmt Namen von bis zu {n} Bytes, mit allen Ordnern.",
    "{path} could not be written whole. Is the disk full?":
        "{path} konnte nicht vollständig geschrieben werden. Ist der Datenträger voll?",
    "{path} is no file but a folder or a device. Choose another name.":
        "{path} ist keine Datei, sondern ein Ordner oder ein Gerät. Bitte einen anderen Namen wählen.",
    "{path} is read, and would be written over. Choose another name.":
        "{path} wird gelesen und würde überschrieben. Bitte einen anderen Namen wählen.",
    "{path} would be written over {other}. Give each file a name of its own.":
        "{path} würde {other} überschreiben. Jede Datei braucht einen eigenen Namen.",
    "{n} {n:file|files} in {folder}": "{n} {n:Datei|Dateien} in {folder}",
    "{name} is moved by {rig}, too: the new bones lie where it is at rest":
        "{name} wird auch von {rig} bewegt: Die neuen Knochen liegen dort, wo es in Ruhe ist",
    "{name} has {n} {n:bone|bones}": "{name} hat {n} Knochen",
    "A part needs a name.": "Ein Teil braucht einen Namen.",
    "Rename Part": "Teil umbenennen",
    "Add parts to those that are chosen; a click takes one away again":
        "Teile zu den gewählten hinzunehmen; ein Klick nimmt eines wieder weg",
    "Choose and change parts: what is under the pointer is filled and named":
        "Teile wählen und ändern: Was unter dem Zeiger liegt, wird gefüllt und benannt",
    "Choose the part that you click, or all parts that are seen in a box that you drag; beside parts, other objects":
        "Das angeklickte Teil wählen oder alle, die in einem aufgezogenen Rahmen zu sehen sind; daneben andere Objekte",
    "Choose these parts and no others": "Diese Teile und keine anderen wählen",
    "Give another name to the part under the pointer, or else to the active one":
        "Dem Teil unter dem Zeiger, sonst dem aktiven, einen anderen Namen geben",
    "Hide the faces of the chosen parts, beside those that are hidden":
        "Die Flächen der gewählten Teile verbergen, zu denen, die es schon sind",
    "Say that a key which would move or delete the object does nothing while the tool is the active one":
        "Sagen, dass eine Taste, die das Objekt bewegen oder löschen würde, mit diesem Werkzeug nichts tut",
    "Take parts from those that are chosen": "Teile von den gewählten wegnehmen",
    "The new name of the active part": "Der neue Name des aktiven Teils",
    "This key does nothing to parts. Choose another tool to move or delete the object.":
        "Diese Taste tut mit Teilen nichts. Zum Bewegen oder Löschen des Objekts bitte ein anderes Werkzeug wählen.",
    "All of the boundary of {name}": "Die ganze Grenze von {name}",
    "All that was painted is locked. Unlock it in the list first.":
        "Alles Bemalte ist gesperrt. Bitte zuerst in der Liste entsperren.",
    "All that was painted is {name} already.": "Alles Bemalte gehört schon zu {name}.",
    "Boundary of {name} at {other}": "Grenze von {name} zu {other}",
    "How many rings, negative inwards; 0 for as far as the next crease beyond the weakest stretch":
        "Wie viele Ringe, negativ nach innen; 0 bis zur nächsten Falte hinter der schwächsten Strecke",
    "How many rings, positive outwards; 0 for as far as the next crease":
        "Wie viele Ringe, positiv nach außen; 0 bis zur nächsten Falte",
    "Into {name}": "Zu {name}",
    "Move the boundary of each chosen part inwards, ring by ring":
        "Die Grenze jedes gewählten Teils Ring für Ring nach innen schieben",
    "Move the boundary of each chosen part outwards, ring by ring":
        "Die Grenze jedes gewählten Teils Ring für Ring nach außen schieben",
    "Move the mouse left and right to slide it    A: all of it    Enter: confirm    Esc: cancel":
        "Maus nach links und rechts: schieben    A: die ganze    Eingabe: bestätigen    Esc: abbrechen",
    "Neighbor": "Nachbar",
    "Nothing beyond the boundary can be taken or given: it is locked, or all there is.":
        "An der Grenze lässt sich nichts nehmen oder geben: Es ist gesperrt oder schon alles.",
    "Number of the part at which the boundary slides; 0 for all of the boundary":
        "Nummer des Teils, an dem die Grenze geschoben wird; 0 für die ganze Grenze",
    "Rings": "Ringe",
    "what is left is in {n} {n:part|parts} more": "der Rest zerfiel in {n} {n:Teil|Teile} mehr",
    "nothing is left of {names}": "von {names} ist nichts mehr übrig",
    "what is left of {givers} is in {n} {n:part|parts} more: {names}":
        "der Rest von {givers} zerfiel in {n} {n:Teil|Teile} mehr: {names}",
    "{names} gave away {n} {n:face|faces}": "{names}: {n} {n:Fläche|Flächen} abgegeben",
    "{names} took {n} {n:face|faces}": "{names}: {n} {n:Fläche|Flächen} dazugekommen",
    "{n} {n:is locked and stays|are locked and stay}": "{n} {n:ist gesperrt und bleibt|sind gesperrt und bleiben}",
    "{n} {n:does not touch it and is a part of its own|do not touch it and are parts of their own}":
        "{n} {n:berührt es nicht und ist ein eigenes Teil|berühren es nicht und sind eigene Teile}",
    "{n} {n:face|faces} of {givers} {n:does|do} not touch {name}: a part apart":
        "{n} {n:Fläche|Flächen} von {givers} {n:berührt|berühren} {name} nicht: ein Teil für sich",
    "{n} {n:face|faces} of {givers} {n:is|are} {name} now":
        "{n} {n:Fläche|Flächen} von {givers} {n:gehört|gehören} jetzt zu {name}",
    "{rings} {rings:ring|rings}, {low} to {high}    Wheel or a number: rings, minus inwards    Click, Enter: confirm  "
    "  "
    "Esc: cancel":
        "{rings} {rings:Ring|Ringe}, {low} bis {high}    Rad, Zahl: Ringe, minus nach innen    "
        "Klick, Eingabe: bestätigen    Esc: abbrechen",
    "The pieces of {name} are of other parts than are shown now: separate them again.":
        "Die Stücke von {name} sind von anderen Teilen, als jetzt zu sehen sind: bitte neu trennen.",
}
