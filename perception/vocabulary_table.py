"""The table behind ``vocabulary``: one line a category, meant to be read and extended.

Columns: labels (first is the usual name, others are other names of the same thing) | flags | typical size in meters
(x long side, y short side, z height) | categories that people ask for.

Flags: ``g`` can be grasped, ``s`` things are put on it, ``c`` things are put in it, ``f`` furniture or appliance that
stands or hangs where it is, ``b`` a ball, ``r`` round seen from above, ``l`` things may lie at several heights of it
(shelf boards, a seat below a backrest), ``w`` does not stand on the floor (hangs on a wall or lies on something),
``x`` background: part of the building, never an object.
"""

from __future__ import annotations

ROWS = """
table, dining table, coffee table, side table, table-merged | sf | 1.2 0.8 0.75 | furniture
nightstand, bedside table | sf | 0.45 0.4 0.55 | furniture
desk | sf | 1.4 0.7 0.75 | furniture
counter, kitchen counter, countertop, counter-other-merged, worktop, kitchen island | sf | 1.8 0.6 0.9 | furniture
bench | sf | 1.2 0.4 0.45 | furniture seat
stool | sfrl | 0.35 0.35 0.5 | furniture seat
chair, armchair, office chair | sfl | 0.5 0.5 0.9 | furniture seat
sofa, couch | sfl | 1.9 0.9 0.8 | furniture seat
bed | sfl | 2.0 1.5 0.6 | furniture
shelf, bookshelf, bookcase, shelf-merged, rack | sfl | 0.9 0.35 1.8 | furniture storage
wardrobe, closet | f | 1.2 0.6 1.9 | furniture storage
cabinet, cupboard, cabinet-merged | sf | 0.9 0.5 0.9 | furniture storage
sideboard, dresser, chest of drawers, tv stand, console | sf | 1.2 0.45 0.8 | furniture storage
drawer | cfw | 0.5 0.45 0.2 | furniture storage
fridge, refrigerator, freezer | cf | 0.65 0.65 1.8 | appliance
stove, cooker, range | sf | 0.6 0.6 0.9 | appliance
oven | cf | 0.6 0.6 0.6 | appliance
microwave | cfw | 0.5 0.4 0.3 | appliance
toaster | fw | 0.3 0.2 0.2 | appliance
dishwasher | cf | 0.6 0.6 0.85 | appliance
washing machine, washer | sf | 0.6 0.6 0.85 | appliance
sink, washbasin | cf | 0.6 0.5 0.85 | fixture
toilet | f | 0.7 0.4 0.8 | fixture
bathtub, bath | cf | 1.7 0.75 0.55 | fixture
shower | f | 0.9 0.9 2.0 | fixture
mirror, mirror-stuff | fw | 0.6 0.05 0.9 | fixture
tv, television, monitor, screen | fw | 1.0 0.15 0.6 | electronics
lamp, light, floor lamp | fr | 0.35 0.35 1.5 | furniture
plant, potted plant, houseplant | fr | 0.4 0.4 0.8 | decoration
piano | sf | 1.5 0.6 1.2 | furniture
trash can, bin, trash bin, waste basket | cfr | 0.3 0.3 0.5 | container
basket, laundry basket | cr | 0.35 0.35 0.25 | container
box, crate, carton | gc | 0.3 0.2 0.2 | container
tray | s | 0.4 0.3 0.04 | tableware
bag, backpack, handbag, suitcase | c | 0.35 0.2 0.4 | container
vase | gr | 0.12 0.12 0.25 | decoration
bottle, water bottle, wine bottle | gr | 0.07 0.07 0.24 | drink
can, soda can, tin | gr | 0.066 0.066 0.12 | drink
juice, juice box, milk, milk carton, carton of milk | g | 0.07 0.07 0.2 | drink
cup, mug, coffee cup, teacup | gr | 0.08 0.08 0.1 | tableware drinkware
glass, wine glass, drinking glass | gr | 0.07 0.07 0.14 | tableware drinkware
jug, pitcher, kettle, teapot | gr | 0.15 0.15 0.22 | tableware kitchenware
bowl | gcr | 0.15 0.15 0.07 | tableware
plate, dish | gsr | 0.22 0.22 0.025 | tableware
fork | g | 0.19 0.025 0.02 | tableware cutlery
knife | g | 0.22 0.025 0.02 | tableware cutlery tool
spoon | g | 0.18 0.04 0.02 | tableware cutlery
pan, pot, frying pan | gr | 0.25 0.25 0.1 | kitchenware
apple | gb | 0.08 0.08 0.08 | fruit food snack
orange | gb | 0.08 0.08 0.08 | fruit food snack
banana | g | 0.19 0.04 0.04 | fruit food snack
lemon, pear, peach, tomato | gb | 0.07 0.07 0.07 | fruit food
carrot, broccoli | g | 0.18 0.05 0.05 | vegetable food
sandwich | g | 0.14 0.1 0.06 | food snack
hot dog, donut, cake, pizza | g | 0.15 0.12 0.05 | food snack
chips, crisps, snack, cookie, cookies, cracker box, cereal, cereal box | g | 0.18 0.06 0.22 | food snack
chocolate, candy | g | 0.15 0.07 0.03 | food snack
bread | g | 0.25 0.1 0.1 | food
food-other-merged, fruit-merged | g | 0.15 0.1 0.08 | food
book, notebook, magazine | g | 0.22 0.15 0.03 | reading
paper, paper-merged, newspaper, letter, envelope | g | 0.3 0.21 0.01 | reading
pen, pencil, marker | g | 0.14 0.012 0.012 | tool stationery
scissors | g | 0.18 0.07 0.015 | tool stationery
hammer | g | 0.3 0.1 0.035 | tool
screwdriver | g | 0.22 0.03 0.03 | tool
wrench, pliers, drill, saw, tape, flashlight | g | 0.22 0.06 0.04 | tool
toolbox | c | 0.4 0.2 0.2 | container tool
remote, remote control | g | 0.18 0.045 0.025 | electronics
phone, cell phone, smartphone | g | 0.15 0.07 0.01 | electronics
tablet | g | 0.25 0.17 0.01 | electronics
laptop, computer, notebook computer | w | 0.35 0.25 0.2 | electronics
keyboard | gw | 0.43 0.13 0.03 | electronics
mouse, computer mouse | gw | 0.11 0.06 0.04 | electronics
clock, alarm clock | gw | 0.15 0.08 0.15 | decoration
camera, headphones, charger, speaker | gw | 0.15 0.1 0.1 | electronics
ball, sports ball, tennis ball | gb | 0.1 0.1 0.1 | toy
teddy bear, teddy, stuffed animal, doll | g | 0.2 0.15 0.25 | toy
toy, toy car, block, cube, lego, puzzle, dice | g | 0.08 0.08 0.08 | toy
frisbee | gr | 0.27 0.27 0.03 | toy
baseball bat, tennis racket, skateboard | g | 0.7 0.1 0.1 | toy
toothbrush | g | 0.19 0.02 0.02 | hygiene
hair drier, comb, brush | g | 0.2 0.1 0.08 | hygiene
soap, shampoo, toothpaste, lotion | g | 0.08 0.05 0.15 | hygiene
towel, cloth | g | 0.3 0.2 0.05 | hygiene textile
pillow, cushion | w | 0.5 0.35 0.15 | textile
blanket | w | 0.6 0.4 0.2 | textile
medicine, pill bottle, pills, first aid kit | gr | 0.05 0.05 0.09 | medicine
sponge | g | 0.11 0.07 0.04 | cleaning
spray, spray bottle, detergent, cleaner | gr | 0.08 0.08 0.25 | cleaning
candle | gr | 0.07 0.07 0.1 | decoration
picture, painting, picture frame, photo | fw | 0.5 0.04 0.4 | decoration
umbrella | g | 0.8 0.1 0.1 | clothing
shoe, shoes, slipper | g | 0.28 0.1 0.1 | clothing
hat, glove, tie, scarf, sock | g | 0.2 0.15 0.08 | clothing
keys, key, wallet, glasses, sunglasses, watch | g | 0.1 0.06 0.02 | personal
cat, dog, bird | - | 0.5 0.2 0.4 | animal
person, human, man, woman, child | - | 0.5 0.4 1.7 | person
floor, floor-wood, floor-other-merged | x | 0 0 0 |
wall, wall-brick, wall-stone, wall-tile, wall-wood, wall-other-merged | x | 0 0 0 |
ceiling, ceiling-merged, door, door-stuff, window, window-blind, window-other, doorway, door frame | x | 0 0 0 |
rug, rug-merged, carpet, curtain, stairs, roof, sky, sky-other-merged, background, robot, gripper, arm | x | 0 0 0 |
building-other-merged, pavement-merged, rock-merged, tree-merged, grass-merged, dirt-merged, water-other | x | 0 0 0 |
"""

LARGEST = """
banana | 0.28 0.08 0.1
bench | 2.6 0.52 1.1
stool | 0.6 0.6 0.95
chair, office chair | 0.95 0.95 1.4
nightstand, bedside table | 0.85 0.65 0.9
tv stand | 2.8 0.65 0.9
shelf, bookshelf, bookcase | 3.0 0.65 2.8
trash can, bin, trash bin, waste basket | 0.7 0.7 1.2
toilet | 0.95 0.65 1.3
washing machine, washer, dishwasher | 0.85 0.85 1.2
bathtub, bath | 2.2 1.2 0.9
sofa, couch | 3.6 1.8 1.3
bed | 2.5 2.4 1.6
table, dining table | 4.0 2.0 1.2
"""
"""Long side, short side, height in meters that nothing of that name exceeds: what does is something else."""
