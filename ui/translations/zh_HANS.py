# SPDX-License-Identifier: GPL-3.0-or-later
"""简体中文: Simplified Chinese. A draft, which a native speaker has yet to read.

Words, as in Blender's own Chinese where it has them: object 物体, mesh 网格, face 面, vertex 顶点, seam 缝合边,
face set 面组, empty 空物体, armature 骨架, bone 骨骼, modifier 修改器, parent 父级, hull 凸壳, crease 折痕,
loose part 松散块, overlay 叠加; and part 部件, decompose 分解, cut 切口, boundary 边界, border edge 开放边,
graph 图, node 节点, arc 弧, loop 环, level set 等值线, slab 层片, piece 块, mark 勾选.
"""

OPERATORS = {
    # 标签页
    "Decompose": "分解",
    "Decompose into Parts": "分解为部件",
    "Cancel": "取消",
    "Clear Parts": "清除部件",
    "Fewer Parts": "更少部件",
    "More Parts": "更多部件",
    "Fewer or More Parts": "更少或更多部件",
    "Check Parts": "检查部件",
    "Check": "检查",
    "Repair Part": "修复部件",
    "Repair": "修复",
    "Select What Is Wrong": "选择有问题处",
    "Reset Parameters to Preset": "将参数重置为预设",
    "Use Preferences in This Scene": "在此场景中使用偏好设置",
    # 部件列表
    "Select": "选择",
    "Select Faces of Parts": "选择部件的面",
    "Isolate": "隔离",
    "Isolate Parts": "隔离部件",
    "Show All": "显示全部",
    "Show All Parts": "显示全部部件",
    "Mark Parts": "勾选部件",
    "Find Similar Parts": "查找相似部件",
    "Names from Active": "名称取自活动物体",
    "Pick Parts": "拾取部件",
    # 手动更改部件
    "Merge Parts": "合并部件",
    "Merge into Neighbor": "合并到相邻部件",
    "Merge Small": "合并小部件",
    "Merge Small Parts": "合并小部件",
    "Frame Parts": "框显部件",
    "Suggest Names": "建议名称",
    "Split Parts": "拆分部件",
    "Split at Graph Node": "在图节点处拆分",
    "Cut Part at Point": "在点处切割部件",
    "Grow Parts": "扩大部件",
    "Shrink Parts": "收缩部件",
    "Slide Boundary": "滑移边界",
    "Paint into Part": "绘制到部件",
    "Assign Faces to Part": "将面指定给部件",
    "New Part of Selected Faces": "由所选面新建部件",
    "Parts from Face Sets": "由面组生成部件",
    "Release Parts": "释放部件",
    "Release All Parts": "释放全部部件",
    # 图
    "Nodes of Chosen Parts": "所选部件的节点",
    "Show or Hide Graph": "显示或隐藏图",
    "Show Colors": "显示颜色",
    "Show Colors of Parts": "显示部件的颜色",
    "Give Materials": "添加材质",
    "Parts of Selected Nodes": "所选节点的部件",
    "Part of Arc": "弧的部件",
    # 使用部件
    "Separate": "分离",
    "Separate Parts into Objects": "将部件分离为物体",
    "Show Original of Part": "显示部件的原物体",
    "Show Separated Parts": "显示分离出的部件",
    "Seams": "缝合边",
    "Mark Seams between Parts": "在部件之间标记缝合边",
    "Face Sets": "面组",
    "Make Face Sets of Parts": "由部件创建面组",
    "Materials": "材质",
    "Give Each Part a Material": "为每个部件添加材质",
    "Unwrap along Cuts": "沿切口展开",
    "Export to Files...": "导出到文件...",
    "Export Parts to Files": "将部件导出到文件",
    "Make Collision Hulls": "创建碰撞凸壳",
    "Make Collision Hulls of Parts": "由部件创建碰撞凸壳",
    "Make Rigid Bodies": "创建刚体",
    "Make Rigid Bodies of Parts": "由部件创建刚体",
    "Make Armature": "创建骨架",
    "Make Armature from Parts": "由部件创建骨架",
    "Choose Parts": "选取部件",
    "Hide Parts": "隐藏部件",
    "Keep Object": "保留物体",
    "Rename Part": "重命名部件",
    "Grow to Next Crease": "扩大到下一条折痕",
    "Shrink to Next Crease": "收缩到下一条折痕",
}

TOOLS = {
    "Fewer": "更少",
    "More": "更多",
    "Pick": "拾取",
    "Cut": "切割",
    "Slide": "滑移",
    "Paint": "绘制",
    "Action": "动作",
    "Set": "设为",
    "Extend": "扩展",
    "Subtract": "减去",
    "Cuts": "切口",
    "Planar": "平面",
    "Smooth": "平滑",
    "Along Faces": "沿面",
    "Joints": "接头",
    "Joint": "接头",
    "As All": "同全部",
    "Round Pegs": "圆形插销",
    "Square Pegs": "方形插销",
    "Keys": "燕尾插销",
    "Dowels": "圆棒",
    "Magnets": "磁铁",
    "None": "无",
    "Merge": "合并",
    "Grow": "扩大",
    "Rename": "重命名",
    "Hide": "隐藏",
    "Frame": "框显",
    # 方法与块
    "Method": "方法",
    "Perceptual": "感知",
    "Berretti": "Berretti",
    "Lavoue": "Lavoué",
    "Liu": "Liu",
    "Pieces": "块",
    "Together": "共同",
    "Separate": "各自",
}

TEXTS = {
    # 标签页及其字段
    "Reeb Parts": "Reeb Parts",
    "Parts": "部件",
    "Use Parts": "使用部件",
    "Separated Part": "分离出的部件",
    "Field": "场",
    "Graph": "图",
    "Boundaries": "边界",
    "Output": "输出",
    "Overlay": "叠加",
    "{n} {n:part|parts}": "{n} 个部件",
    "{parts} in {seconds:.2f} s": "{parts}，用时 {seconds:.2f} 秒",
    "{n} {n:node|nodes}": "{n} 个节点",
    "{n} {n:arc|arcs}": "{n} 条弧",
    "{n} {n:loop|loops}": "{n} 个环",
    "{nodes}, {arcs}, {loops}": "{nodes}，{arcs}，{loops}",
    "Advanced": "高级",
    # 名称建议
    "Name the parts that you have not named by what they are: head, leg, handle; else by their place and kind":
        "为尚未由您命名的部件按其含义命名：头、腿、柄；否则按其位置和类型命名",
    "All named already: {n} {n:part|parts}": "全部 {n} 个部件均已有名称",
    "{n} {n:part is|parts are} named": "已命名 {n} 个部件",
    "{place} {kind}": "{place}{kind}",
    "body": "身体",
    "head": "头",
    "neck": "颈",
    "arm": "手臂",
    "leg": "腿",
    "tail": "尾",
    "ear": "耳",
    "horn": "角",
    "handle": "柄",
    "ground": "地面",
    "limb": "肢",
    "tip": "尖",
    "piece": "块",
    "front": "前",
    "back": "后",
    "top": "上",
    "bottom": "下",
    "left": "左",
    "right": "右",
    "This viewport does not show the parts.": "此视图未显示部件。",
    "and {n} more {n:model|models}": "以及另外 {n} 个模型",
    "{names} and {n} more": "{names} 以及另外 {n} 个",
    "Show the parts' colors in this viewport: Solid, colored by attribute":
        "在此视图中显示部件的颜色：实体模式，按属性着色",
    "The parts have no colors. Switch these on under Advanced, Output; decompose again.":
        "部件没有颜色。请在“高级”的“输出”中启用颜色，然后重新分解。",
    "Show the Reeb graphs over the selected models, or hide them": "在所选模型上显示或隐藏 Reeb 图",
    "{n} Small {n:Part|Parts}": "{n} 个小部件",
    "Sort": "排序",
    "Size": "尺寸",
    "Place": "位置",
    "In the order of their numbers: those of fewer parts first": "按编号顺序：部件较少时就有的在前",
    "Largest first": "最大的在前",
    "By name": "按名称",
    "Highest first": "最高的在前",
    "The order of the parts in the list": "列表中部件的顺序",
    "Show Small Parts": "显示小部件",
    "List the parts, too, that are smaller than the share set under Advanced, Overlay":
        "同时列出小于“高级”的“叠加”中所设占比的部件",
    "Small Below": "小部件阈值",
    "Parts of a smaller share of the surface are folded into one row where the list is long":
        "列表较长时，表面占比更小的部件会折叠为一行",
    "Merge each of the small parts into the neighbor that it is least clearly cut from":
        "将每个小部件合并到与其分界最不明显的相邻部件",
    "There are no small parts to merge.": "没有可合并的小部件。",
    "{n} small {n:part is|parts are} merged": "已合并 {n} 个小部件",
    "Look at the chosen parts from near": "近看所选部件",
    "Decompose cuts the selected mesh into parts. The mesh itself stays as it is.":
        "“分解”将所选网格切割为部件。网格本身保持不变。",
    "Select a mesh, then press Decompose.": "请选择一个网格，然后按“分解”。",
    "The mesh was edited since. Decompose it again.": "网格在此之后被编辑过。请重新分解。",
    "{n} {n:note|notes} on the mesh": "关于网格的 {n} 条说明",
    "{n} {n:note|notes}": "{n} 条说明",
    "{n} {n:part|parts} cannot be had, only {fewest} to {most}": "无法得到 {n} 个部件，只能为 {fewest} 到 {most} 个",
    "Go to the next number of parts that stands out, such as all limbs, or all fingers":
        "前往下一个明显的部件数量，例如全部肢体或全部手指",
    "More": "更多",
    "More parts; without it, fewer": "更多部件；禁用则为更少部件",
    "There are no more parts than these.": "没有比这更多的部件。",
    "There are no fewer parts than these.": "没有比这更少的部件。",
    "{part} of {name}": "{name} 的 {part}",
    "A part of {name}": "{name} 的部件",
    "Show {name}": "显示 {name}",
    "Show Originals": "显示原物体",
    "New scenes start with these settings.": "新场景以这些设置开始。",
    # 计算进度
    "Reeb Parts: {stage} ({share:.0%})    Esc: cancel": "Reeb Parts：{stage}（{share:.0%}）    Esc：取消",
    "Reeb Parts: {stage} ({share:.0%})    Blender stands still until the parts are there":
        "Reeb Parts：{stage}（{share:.0%}）    部件完成之前 Blender 无法响应",
    "mesh": "网格",
    "distances": "距离",
    "reeb graph": "Reeb 图",
    "cuts": "切口",
    "separating parts": "正在分离部件",
    "reading the mesh": "正在读取网格",
    "starting": "正在启动",
    "writing the parts": "正在写入部件",
    "parts": "部件",
    "done": "完成",
    # 参数
    "Preset": "预设",
    "Set all parameters at once": "一次性设置全部参数",
    "Perceptual": "感知",
    "Berretti 2009": "Berretti 2009",
    "Method": "方法",
    "Lavoue 2005": "Lavoué 2005",
    "Liu 2007": "Liu 2007",
    "How cuts are chosen: as people would, by the paper's rules on the Reeb graph, where curvature changes, or by "
    "cutting in two again and again":
        "切口的选择方式：像人那样切割、按论文在 Reeb 图上的规则、在曲率变化处，或反复一分为二",
    "Curvature Classes": "曲率类别",
    "Lavoue 2005: number of classes of curvature that the surface is sorted into; 0 chooses it from the data":
        "Lavoué 2005：表面按曲率划分的类别数；0 表示由数据决定",
    "Outline": "轮廓",
    "Liu 2007: how far the outline of a part, unfolded into the plane, counts when its cut is judged; 0 judges by the "
    "cut alone":
        "Liu 2007：评判切口时，部件展开到平面后的轮廓所占的比重；0 表示仅按切口本身评判",
    "The name of the part until the user gives it another": "用户另行命名之前部件的名称",
    "Symmetry": "对称",
    "Where the model is its own mirror image, or most of it is, make its parts so, too. Changes by hand are made on "
    "both sides":
        "当模型整体或大部分与自身镜像相同时，其部件也相应对称。手动更改会在两侧同时进行",
    "Hints": "提示",
    "Along UV seams": "沿 UV 缝合边",
    "Along edges that are marked sharp": "沿标记为锐边的边",
    "Hints must be one whole number for each of the {n} faces.": "提示必须为 {n} 个面中的每个面各给出一个整数。",
    "Seams": "缝合边",
    "Sharp Edges": "锐利边",
    "The shape alone decides": "仅由形状决定",
    "What you have marked on the mesh yourself that parts should follow, besides its shape":
        "除形状之外，部件还应遵循您自己在网格上标记的内容",
    "Where the material changes": "在材质变化处",
    "Whether pieces that touch without being joined form parts together, like a sleeve and an arm, or each piece is "
    "decomposed on its own":
        "相互接触但未连接的块是共同构成部件（如衣袖与手臂），还是各自单独分解",
    "Detail": "细节",
    "How readily the surface is cut: 0 gives as few parts as possible, 1 every candidate":
        "切割表面的倾向程度：0 得到尽可能少的部件，1 得到全部候选部件",
    "How readily the surface is cut: 0 gives as few parts as possible, 1 every candidate. Nothing is computed again":
        "切割表面的倾向程度：0 得到尽可能少的部件，1 得到全部候选部件。不会重新计算",
    "Number of Parts": "部件数量",
    "Exactly this many parts instead of a level of detail; 0 lets Detail decide":
        "使用确切的部件数量代替细节级别；0 表示由“细节”决定",
    "Exactly this many parts, whatever the detail. Nothing is computed again":
        "无论细节如何都使用确切的部件数量。不会重新计算",
    "Base Spacing": "基点间隔",
    "Share of the area around each point that distances are measured from; smaller is slower and finer (the paper's "
    "0.005 S)":
        "作为距离测量起点的每个点周围面积所占的比例；越小越慢但越精细（论文中的 0.005 S）",
    "Equalize": "均衡",
    "Give every range of distances the same area, so that long limbs do not hide short ones (the paper's s(p))":
        "使每个距离范围具有相同的面积，避免长肢体掩盖短肢体（论文中的 s(p)）",
    "Levels": "级数",
    "Number of slabs the surface is cut into before parts are formed (1 / epsilon)":
        "形成部件之前将表面切成的层片数量（1 / epsilon）",
    "Small Region": "小区域",
    "Berretti 2009: parts smaller than this share of the largest one join a neighbor; 0.01 keeps fingers":
        "Berretti 2009：小于最大部件的此比例的部件并入相邻部件；0.01 可保留手指",
    "Concavity": "凹度",
    "Berretti 2009: how far a cut may slide to lie in a crease; 0 leaves it where it is (the paper's alpha)":
        "Berretti 2009：切口为落入折痕可滑移的距离；0 表示保持原位（论文中的 alpha）",
    "Band": "带宽",
    "How far to either side a cut may move into a crease, as a share of the radius of a circle as long as the cut; 0 "
    "leaves it where it is":
        "切口可向两侧移入折痕的距离，以与切口等长的圆的半径为单位；0 表示保持原位",
    "The parameter {old} is called {new} now.": "参数 {old} 现名为 {new}。",
    "The model {file} was trained on other features (first: {name}). Train it again.":
        "模型 {file} 是用其他特征训练的（首个：{name}）。请重新训练。",
    "The model {file} was trained on the features in another order. Train it again.":
        "模型 {file} 训练时特征的顺序不同。请重新训练。",
    "Crease Length": "折痕长度",
    "Berretti 2009: how much of a cut's length must be concave to count (the paper's sigma)":
        "Berretti 2009：切口长度中需有多少为凹才计入（论文中的 sigma）",
    "Smoothing": "平滑",
    "Rounds that take saw teeth off the cuts, a face at a time; 0 leaves them as they fall":
        "逐面去除切口锯齿的次数；0 表示保持原样",
    "Follow Level Sets": "沿等值线",
    "Keep cuts on level sets of the distance, as the paper does; off, they follow creases":
        "像论文那样使切口保持在距离的等值线上；禁用时切口沿折痕",
    "Small Loose Part": "小松散块",
    "What touches nothing else, or with Pieces: Separate each loose piece, is one part if its share of the whole "
    "area is less than this":
        "不与其他部分接触者（“块：各自”时为每个松散块），若占总面积的比例小于此值，则为一个部件",
    # 输出
    "Vertex Groups": "顶点组",
    "A vertex group for each part; vertices on a cut belong to every part that meets there":
        "每个部件一个顶点组；切口上的顶点属于在该处相接的每个部件",
    "Face Attribute": "面属性",
    "The number of each face's part as the attribute reeb_part, for Geometry Nodes":
        "以属性 reeb_part 记录每个面所属部件的编号，供几何节点使用",
    "Colors": "颜色",
    "The parts' colors as the active color attribute Reeb Parts": "以活动颜色属性 Reeb Parts 保存部件的颜色",
    "Palette": "调色板",
    "What the parts' colors are chosen from. A color that you give to a part in the list stays the part's own":
        "部件颜色的来源。您在列表中指定给部件的颜色会一直保留",
    "Color-Blind Safe": "色盲友好",
    "Bright": "鲜艳",
    "Pastel": "柔和",
    "Face Sets": "面组",
    "A face set for each part, for Sculpt Mode; Clear brings your own back":
        "每个部件一个面组，用于雕刻模式；“清除部件”会恢复您自己的面组",
    "Materials": "材质",
    "A material for each part; Clear brings your own back": "每个部件一个材质；“清除部件”会恢复您自己的材质",
    "Seams along Cuts": "沿切口的缝合边",
    "UV seams where parts meet, beside your own; Clear removes only these":
        "在部件相接处添加 UV 缝合边，您自己的予以保留；“清除部件”仅移除这些缝合边",
    "Distance Field": "距离场",
    "The normalized average geodesic distance that the parts come from, as the vertex attribute reeb_agd: 0 in the "
    "middle of the body, 1 at the farthest tip":
        "部件所依据的归一化平均测地距离，保存为顶点属性 reeb_agd：身体中部为 0，最远的尖端为 1",
    "The Reeb graph as objects: an empty for each node, a curve for the arcs":
        "以物体表示的 Reeb 图：每个节点一个空物体，弧为一条曲线",
    # 叠加
    "Node Size": "节点尺寸",
    "Size of the empties, as a share of the object's": "空物体的尺寸，占物体尺寸的比例",
    "Line Thickness": "线条宽度",
    "Thickness of the curve under the lines, as a share of the radius of the body around it":
        "线条下曲线的粗细，占其周围形体半径的比例",
    "In Front": "在前面",
    "Draw the graph over the model instead of hidden inside it": "将图绘制在模型之上，而不是隐藏在模型内部",
    "Outline Chosen Parts": "勾勒所选部件",
    "Draw a line around the parts that are chosen in the list": "在列表中所选部件的周围绘制线条",
    "Show Cuts": "显示切口",
    "Draw all borders between parts where Separate would cut them, by its setting Cuts":
        "绘制部件之间的所有边界，即“分离”按其“切口”设置进行切割的位置",
    "The parameters that new scenes start with": "新场景的起始参数",
    "The preferences were taken over": "已采用偏好设置",
    # 部件列表
    "Name": "名称",
    "Name of the part and of its vertex group; double click to change it": "部件及其顶点组的名称；双击可更改",
    "Number": "编号",
    "What the part is known by; the value of reeb_part": "部件的标识；即 reeb_part 的值",
    "Color": "颜色",
    "Color of the part; one that you choose stays with it": "部件的颜色；您选定的颜色会一直保留",
    "Empty: the part's own": "留空：部件自己的名称",
    "Share": "占比",
    "Share of the surface's area": "占表面积的比例",
    "Locked": "已锁定",
    "The part stays as it is, whatever the detail and whatever is done to its neighbors":
        "无论细节如何、相邻部件如何更改，该部件均保持不变",
    "Pinned": "钉住",
    "The part was changed by hand and stays whatever the detail": "该部件经过手动更改，无论细节如何都予以保留",
    "The part is pinned by its lock alone, and was not changed by hand": "该部件仅因锁定而钉住，未经手动更改",
    "Selected": "选中项",
    "Included in what is done to the chosen parts": "包含在对所选部件的操作中",
    "The vertex group made for the part": "为部件创建的顶点组",
    "The material made for the part": "为部件创建的材质",
    "The mesh was edited since": "网格在此之后被编辑过",
    "The number of parts decides, not the detail": "由部件数量而非细节决定",
    "Active Part": "活动部件",
    # 使用部件
    "Which parts to use": "使用哪些部件",
    "All": "全部",
    "All parts of the mesh": "网格的全部部件",
    "Chosen": "所选",
    "The parts marked in the list, or else the active one": "列表中勾选的部件；若无勾选则为活动部件",
    "Closed, crosses nothing": "封闭且无相交",
    "{n} open {n:edge|edges}": "{n} 条开放边",
    "{n} {n:edge|edges} of three faces": "{n} 条边连接三个面",
    "Faces look both ways at {n} {n:edge|edges}": "{n} 条边两侧的面朝向不一致",
    "{n} {n:face crosses|faces cross} others": "{n} 个面与其他面相交",
    "Inside out": "内外翻转",
    "Thinnest place: {width}": "最薄处：{width}",
    "Check the selected separated parts: whether they are closed, cross themselves or are inside out":
        "检查所选的分离部件：是否封闭、是否自相交或内外翻转",
    "Select, in Edit Mode, the faces of the part where something is wrong": "在编辑模式中选择部件有问题处的面",
    "Kind": "类型",
    "What to select": "要选择的内容",
    "Open Edges": "开放边",
    "Faces at edges of one face": "仅属于一个面的边所在的面",
    "Branching Edges": "分叉边",
    "Faces at edges of three faces or more": "三个或更多面共用的边所在的面",
    "Faces That Look Both Ways": "朝向不一致的面",
    "Faces at edges where one looks out and the other in": "一个朝外、另一个朝内的两个面共用的边所在的面",
    "Crossing Faces": "相交面",
    "Faces that cross others": "与其他面相交的面",
    "Thinnest Place": "最薄处",
    "The face where the part is thinnest": "部件最薄处的面",
    "Turn faces that look inwards, close holes, and make caps anew that cross something, where that helps":
        "翻转朝内的面、封闭孔洞，并在有效时重做与其他面相交的封盖",
    "Where the pieces are cut from each other; the mesh itself stays as it is":
        "块与块之间的切割位置；网格本身保持不变",
    "Along a smooth curve, which lies in a plane where one fits: the faces there are divided in the pieces. Borders "
    "that are smooth already stay as they are":
        "沿平滑曲线切割，合适时曲线位于一个平面内：该处的面在块中被分割。已经平滑的边界保持不变",
    "In a plane, the one that fits best, wherever that tears no part; else as Smooth":
        "在最合适的平面内切割，只要不会撕裂部件；否则与“平滑”相同",
    "Along the edges of faces, all of which stay whole": "沿面的边切割，所有面保持完整",
    "Close Holes": "封闭孔洞",
    "Close the holes where parts were joined, so that each piece is closed; borders that the mesh had before stay "
    "open. The faces are marked by the attribute reeb_cap":
        "封闭部件相连处的孔洞，使每一块都封闭；网格原有的开放边保持开放。新面以属性 reeb_cap 标记",
    "Cap Material": "封盖材质",
    "Give the faces that close holes a material of their own, Cap, which all pieces share; without it, they have that "
    "of the faces beside them":
        "给封闭孔洞的面一个自己的材质 Cap，所有块共用；否则使用相邻面的材质",
    "Close the holes where parts were joined, so that each file holds a closed body":
        "封闭部件相连处的孔洞，使每个文件都包含一个封闭的实体",
    "Origin in the Middle": "原点居中",
    "Put the origin of each piece to the middle of its surface; without it, all keep the origin of the object":
        "将每一块的原点置于其表面的中心；禁用时各块保留物体的原点",
    "Keep Modifiers": "保留修改器",
    "Copy the object's modifiers to each piece. Where one works about the origin, as Mirror does, the pieces keep the "
    "origin of the object, so that all stays in its place":
        "将物体的修改器复制到每一块。若有修改器以原点为准（如镜像），则各块保留物体的原点，使一切位置不变",
    "Apply Modifiers": "应用修改器",
    "Cut the mesh as it is seen, with its modifiers applied, instead of the one that is stored; the pieces then have "
    "no modifiers":
        "按应用修改器后所见的网格切割，而不是按存储的网格；得到的块不再有修改器",
    "The modifiers of {name} make {n} {n:face that belongs|faces that belong} to no part. Apply the modifiers and "
    "decompose again.":
        "{name} 的修改器生成了 {n} 个不属于任何部件的面。请应用修改器并重新分解。",
    "Parent to Original": "以原物体为父级",
    "Make the pieces children of the object, so that they follow it; without it, they have the parent that the object "
    "has":
        "使各块成为物体的子级并跟随物体；禁用时各块沿用物体的父级",
    "Hide Original": "隐藏原物体",
    "Hide the object, which stays as it is, in the viewport and in renders": "在视图和渲染中隐藏原物体，其内容保持不变",
    "Where the separated parts are": "分离出的部件所在位置",
    "Explode": "爆破",
    "How far the parts drift apart, as a multiple of their distance from the middle. Only looks so: at 0 the mesh is "
    "as it was. Can be animated":
        "部件散开的距离，为其到中心距离的倍数。仅改变外观：为 0 时网格与之前相同。可设置动画",
    # 操作项的提示
    "Cut the selected mesh into the parts a person would name, and show its Reeb graph":
        "将所选网格切割为人会命名的部件，并显示其 Reeb 图",
    "Stop computing; the scene is as it was before": "停止计算；场景与之前相同",
    "Remove everything that Reeb Parts has added to the selected meshes; what was there before is back. A UV map that "
    "you have changed or renamed stays, and so do colors that you have painted on, weights of the armature that you "
    "have changed, and the objects made of parts: separated pieces, as your own that do not lead back to the mesh, "
    "hulls and armatures":
        "移除 Reeb Parts 添加到所选网格的一切；恢复之前的内容。您更改或重命名过的 UV 贴图、您绘制过的颜色、您更改过的"
        "骨架权重会保留，由部件创建的物体也会保留：分离出的各块（成为您自己的物体，不再与原网格关联）、凸壳和骨架",
    "Set this scene's preset, output and overlay as new scenes have them; see Preferences, Add-ons":
        "将此场景的预设、输出和叠加设为与新场景相同；参见偏好设置的“插件”",
    "Set the parameters back to those of the preset; some of them were changed":
        "将参数恢复为预设的值；其中一些已被更改",
    "Select the faces of the parts chosen in the list, for Edit Mode": "选择列表中所选部件的面，用于编辑模式",
    "Action": "动作",
    "Select these faces and no others": "仅选择这些面",
    "Extend": "扩展",
    "Add these faces to the selection": "将这些面添加到选择中",
    "Take these faces from the selection": "从选择中移除这些面",
    "Part": "部件",
    "Number of the part; 0 for those chosen in the list": "部件的编号；0 表示列表中所选的部件",
    "Hide all faces but those of the chosen parts, or show all again": "隐藏所选部件以外的所有面，或重新显示全部",
    "Show All": "显示全部",
    "Show every face again": "重新显示所有面",
    "Mark parts in the list": "在列表中勾选部件",
    "Mark the parts that are like the active one in size, shape and place, on all objects of the scene":
        "在场景的所有物体上，勾选与活动部件在尺寸、形状和位置上相似的部件",
    "Difference": "差值",
    "All Objects": "全部物体",
    "Name the parts of all decomposed objects, not only of selected ones":
        "为所有已分解物体的部件命名，而不仅是所选物体",
    "How much parts may differ: 0 finds copies only, 1 most parts of a kind":
        "允许部件之间的差异：0 仅查找副本，1 查找同类的大多数部件",
    "Give parts of the other selected objects the names of the same parts of the active one, in any pose":
        "将活动物体各部件的名称赋予其他所选物体的相同部件，不论姿态",
    "Mark every part": "勾选每个部件",
    "None": "无",
    "Mark no part": "不勾选任何部件",
    "Invert": "反转",
    "Mark the parts that are not chosen": "勾选未选中的部件",
    "Smaller": "较小",
    "Mark the parts smaller than the active one": "勾选小于活动部件的部件",
    "Of Selected Faces": "所选面的部件",
    "Mark the parts that have selected faces": "勾选含有所选面的部件",
    "Choose parts by clicking on the model or its graph; Shift chooses several":
        "在模型或其图上单击以选择部件；按住 Shift 可选择多个",
    "A place on or beside the part, in the world": "部件上或其旁边的一个位置，世界坐标",
    "On the Graph": "在图上",
    "The location is on an arc of the graph; without it, on the surface": "位置在图的弧上；禁用时在表面上",
    "Add the part to those that are chosen, or take it away again": "将部件添加到所选部件中，或从中移除",
    "Number of the part that becomes the active one; 0 for the part at the location":
        "成为活动部件的部件编号；0 表示该位置处的部件",
    "Marked": "已勾选",
    "With a number of a part: numbers of the parts that are marked, separated by commas":
        "与部件编号一起使用：已勾选部件的编号，以逗号分隔",
    "Location": "位置",
    "Make one part of the parts marked in the list; it takes the name of the active one":
        "将列表中勾选的部件合并为一个；采用活动部件的名称",
    "Merge each chosen part into the neighbor that it is least clearly cut from":
        "将每个所选部件合并到与其分界最不明显的相邻部件",
    "Split each chosen part in two, where its own best cut is": "在每个所选部件自身的最佳切口处将其一分为二",
    "Cut a part where you click, on the graph or on the surface; a ring shows where the cut will be":
        "在图或表面上单击处切割部件；圆环显示切口的位置",
    "Where to cut, in the world": "切割的位置，世界坐标",
    "Slide the boundary of the active part over the surface with the mouse": "用鼠标在表面上滑移活动部件的边界",
    "Distance": "距离",
    "How far along the surface; negative inwards": "沿表面的距离；负值为向内",
    "Paint faces of other parts into the active part, with the pointer; locked parts stay":
        "用指针将其他部件的面绘制到活动部件；已锁定的部件不变",
    "Radius": "半径",
    "Of the brush, in the units of the mesh": "笔刷的半径，以网格的单位计",
    "Give the faces selected in Edit Mode to the active part": "将编辑模式中所选的面指定给活动部件",
    "New Part": "新建部件",
    "Make a part of its own of the faces": "将这些面作为单独的部件",
    "Take over what you have painted with face sets in Sculpt Mode: each face goes to the part of its face set":
        "采用您在雕刻模式中用面组绘制的内容：每个面归入其面组的部件",
    "Let the detail decide about the chosen parts again, which were changed by hand":
        "使手动更改过的所选部件重新由细节决定",
    "Release every part that is not locked": "释放每个未锁定的部件",
    "Choose the parts of the selected nodes in the list, and make their object active":
        "在列表中选择所选节点的部件，并将其物体设为活动物体",
    "Choose the part in which an arc was clicked, and make its object active":
        "选择所单击的弧所在的部件，并将其物体设为活动物体",
    "A place on or beside the arc, in the world": "弧上或其旁边的一个位置，世界坐标",
    "Select the nodes of the chosen parts": "选择所选部件的节点",
    "Split the part that holds the selected node, at the best cut along the node's arcs":
        "沿节点的弧在最佳切口处拆分所选节点所在的部件",
    "Make separate objects of the parts, with all that the mesh carries; the original stays as it is":
        "由部件创建单独的物体，并带有网格的全部数据；原物体保持不变",
    "Show and select the objects that the selected pieces were separated from, and hide the pieces":
        "显示并选择所选各块所分离自的物体，并隐藏各块",
    "Show and select the pieces that were separated from the selected objects, and hide these":
        "显示并选择从所选物体分离出的各块，并隐藏这些物体",
    "Take Back": "撤回",
    "Take them away again; what was there before is back": "将其移除；恢复之前的内容",
    "Mark UV seams where parts meet, beside your own; they follow the parts":
        "在部件相接处标记 UV 缝合边，您自己的予以保留；缝合边随部件更新",
    "Make a face set of each part, for Sculpt Mode; they follow the parts":
        "由每个部件创建面组，用于雕刻模式；面组随部件更新",
    "Give each part a material of its own, in the part's color; they follow the parts":
        "为每个部件添加与其颜色相同的单独材质；材质随部件更新",
    "Unwrap the mesh along the cuts between parts and your own seams, into a UV map of its own":
        "沿部件之间的切口和您自己的缝合边，将网格展开到单独的 UV 贴图",
    "Open Tubes": "剖开管状",
    "Also cut parts open where they would not lie flat: tubes along, and toward tips. These seams run on inner sides "
    "and along creases, and are not marked on the mesh":
        "对无法展平的部件也进行剖开：管状部件沿长度方向剖开，并向尖端剖开。这些缝合边位于内侧和折痕处，不在网格上标记",
    "Stack Twins": "堆叠镜像对",
    "Lay parts whose meshes are mirror images of each other over each other, so that both share one place in the "
    "texture":
        "将网格互为镜像的部件相互重叠放置，使二者共用纹理中的同一位置",
    "Minimum Stretch": "最小拉伸",
    "Areas and angles as even as can be": "使面积和角度尽可能均匀",
    "Angles even, areas less; faster": "角度均匀，面积次之；较快",
    "The fastest, and the least even": "最快，但最不均匀",
    "How faces are laid flat": "面的展平方式",
    "Angle Based": "基于角度",
    "Conformal": "共形",
    "Write each part to a file of its own, or all to one, in a folder; files of the same names are replaced":
        "将每个部件写入单独的文件，或全部写入一个文件，存放在一个文件夹中；同名文件会被替换",
    "One File": "单个文件",
    "Write all parts of an object to one file, as objects of their own where the format knows objects; 3MF always does":
        "将一个物体的全部部件写入一个文件，若格式支持物体则各为单独的物体；3MF 始终如此",
    "For slicers: all parts of an object as one assembly, with names and colors":
        "用于切片软件：一个物体的全部部件组成一个装配体，带有名称和颜色",
    "Folder": "文件夹",
    "Where the files go; made if it is not there": "文件的存放位置；不存在时会创建",
    "Format": "格式",
    "Kind of the files": "文件的类型",
    "OBJ": "OBJ",
    "Wavefront, with materials": "Wavefront，带材质",
    "PLY": "PLY",
    "Stanford, with the colors of the mesh": "Stanford，带网格自身的颜色",
    "STL": "STL",
    "For 3D printing": "用于 3D 打印",
    "3MF": "3MF",
    "glTF Binary": "glTF 二进制",
    "With materials and textures": "带材质和纹理",
    "Make an armature that moves the mesh smoothly, with a bone along the center line of each part that can bend":
        "创建骨架，每个可弯曲的部件一根骨骼，沿部件的中心线，使网格平滑变形",
    "Weights": "权重",
    "How much each bone moves each vertex; at most four bones move one":
        "每根骨骼对每个顶点的影响程度；一个顶点最多受四根骨骼影响",
    "Smooth": "平滑",
    "Change smoothly across the cuts, as far as the limb is thick": "在切口两侧平滑过渡，范围与肢体的粗细相当",
    "Automatic": "自动",
    "Blender's own, by heat from the bones": "Blender 自带的方式，由骨骼的热量计算",
    "Each part moves as a whole, by its own vertex group": "每个部件以其自己的顶点组整体移动",
    "Blender finds no automatic weights for {name}. Choose smooth weights.":
        "Blender 无法为 {name} 找到自动权重。请选择平滑权重。",
    "{name} shares its mesh, and so its weights, with {other}, which has an armature of its parts. Give {name} a mesh "
    "of its own (Object > Relations > Make Single User > Object & Data) and try again.":
        "{name} 与 {other} 共用网格及其权重，后者已有由部件生成的骨架。请让 {name} 使用单独的网格"
        "（物体 > 关系 > 创建单一用户 > 物体和数据）并重试。",
    "{n} {n:part moves with the one it hangs|parts move with the ones they hang} on: no neck to bend at":
        "{n} 个部件随其所连的部件一起移动：没有可弯折的颈部",
    "Move the Mesh": "带动网格",
    "Add an Armature modifier, so that posing the bones moves the parts": "添加骨架修改器，使骨骼的姿态带动部件",
    "Make convex hulls of each part, of at most 64 corners, with which games and simulations collide":
        "为每个部件创建凸壳，最多 64 个角点，供游戏和模拟进行碰撞",
    "Hulls per Part": "每个部件的凸壳数",
    "How many hulls a part has at most; a part that one hull fits well has one":
        "一个部件最多有几个凸壳；一个凸壳已很贴合的部件只有一个",
    "Make rigid bodies of the separated parts, held together at the cuts; press Play to see them fall":
        "将分离出的部件变为刚体，在切口处相连；按播放即可看到它们下落",
    "Joints": "关节",
    "How parts hold together at the cuts": "部件在切口处如何相连",
    "Hinges": "铰链",
    "Bend about the longest line of the cut": "绕切口最长的线弯折",
    "Points": "点",
    "Turn in every direction about the middle of the cut": "绕切口中心向各方向转动",
    "Fixed": "固定",
    "Do not move": "不活动",
    "{n} {n:rigid body|rigid bodies}, {total} {total:joint|joints}": "{n} 个刚体，{total} 个关节",
    "Names": "名称",
    "How the hulls are called, so that the game engine finds them": "凸壳的命名方式，以便游戏引擎识别",
    "Unreal": "Unreal",
    "UCX_, the object and a number": "UCX_、物体和编号",
    "Godot": "Godot",
    "The part, then -convcolonly": "部件，后接 -convcolonly",
    # 打印用的接头
    "No joints; Close Holes decides whether pieces are closed": "无接头；各块是否封闭由“封闭孔洞”决定",
    "The smaller piece has a round peg, the other a hole for it": "较小的一块带有圆形插销，另一块带有对应的孔",
    "Pegs that do not turn in their holes": "在孔中不会转动的插销",
    "Pegs like the tail of a dove, which fit into their holes one way round only":
        "形如燕尾的插销，只能以一个方向插入孔中",
    "Both pieces have a hole, and a loose dowel goes into both": "两块都有孔，一根独立的圆棒插入两孔",
    "Both pieces have a round hole for a magnet, as deep as Depth says": "两块都有放置磁铁的圆孔，深度由“深度”决定",
    "What joins the pieces when they are printed, along the axis of each cut; holes are closed then. "
    "A cut without room for it stays without":
        "打印后用什么连接各块，沿每个切口的轴线；此时会封闭孔洞。没有空间的切口不加接头",
    "Per Cut": "每个切口",
    "How many joints a cut gets where there is room for them; two or more keep pieces from turning":
        "空间足够时每个切口有几个接头；两个或更多可防止各块转动",
    "Width (mm)": "宽度（毫米）",
    "Width of the joints in millimeters; 0 for a third of each cut's. Where there is no room, they are smaller":
        "接头的宽度，以毫米为单位；0 表示每个切口宽度的三分之一。空间不足时会更小",
    "Depth (mm)": "深度（毫米）",
    "How deep joints go into a piece, in millimeters; 0 for what suits their width":
        "接头伸入一块的深度，以毫米为单位；0 表示与宽度相称的深度",
    "Clearance (mm)": "间隙（毫米）",
    "Gap between a joint and its hole all around, in millimeters": "接头与孔之间四周的间隙，以毫米为单位",
    "Wall (mm)": "壁厚（毫米）",
    "The least thickness of what remains around a joint, in millimeters; at least a third of its radius":
        "接头周围所剩部分的最小厚度，以毫米为单位；至少为其半径的三分之一",
    "{n} of {total} {total:cut has|cuts have} joints": "{total} 个切口中有 {n} 个带接头",
    "No joint where there is no room for one with a wall around it: {cuts}":
        "没有空间容纳带壁的接头，因此无接头：{cuts}",
    "No joint where a cut is so bent that it has no axis: {cuts}": "切口过于弯曲而没有轴线，因此无接头：{cuts}",
    "No joint where a part is not closed or crosses itself: {cuts}": "部件未封闭或自相交，因此无接头：{cuts}",
    "No joint where it would have left a part open or pierced: {cuts}": "接头会使部件开口或被穿透，因此无接头：{cuts}",
    "What Joints says": "按“接头”的设置",
    "What joins these two pieces when the parts are separated the next time": "下次分离部件时用什么连接这两块",
    "{n} {n:joint|joints}, {width} mm wide": "{n} 个接头，宽 {width} 毫米",
    "Fit the Bed": "适合打印床",
    "Cut parts that are longer than the printer's bed further, in planes across them":
        "将长于打印床的部件沿横向平面继续切开",
    "Bed (mm)": "打印床（毫米）",
    "Width, depth and height that can be printed, in millimeters; pieces may be turned to fit":
        "可打印的宽度、深度和高度，以毫米为单位；各块可以旋转以放入",
    "{n} more {n:piece|pieces}, so that all fit the bed": "为适合打印床而多出 {n} 块",
    "Not closed, so not cut to fit the bed: {names}": "未封闭，因此未按打印床切开：{names}",
    "Separated Pieces": "分离出的块",
    "Write the pieces that were separated, with their joints and dowels, as they are now":
        "写出分离出的各块，连同接头和圆棒，保持当前状态",
    "There are no separated parts of {name}. Separate them first.": "{name} 没有分离出的部件。请先分离。",
    "No room with a wall around it": "没有留出壁厚的空间",
    "Too bent to have an axis": "过于弯曲，没有轴线",
    "A part is not closed": "有部件未封闭",
    "It would spoil a part": "会损坏部件",
    "There would be more than {n} pieces. Is the bed in millimeters?": "将超过 {n} 块。打印床是以毫米为单位吗？",
    # 关于网格的说明
    "{n} {n:edge joins|edges join} more than two faces (non-manifold).": "{n} 条边连接两个以上的面（非流形）。",
    "{n} {n:face lies|faces lie} on another one with the same corners, and {n:has|have} its part.":
        "{n} 个面与另一个顶点相同的面重合，属于同一部件。",
    "{n} {n:face lies|faces lie} within the solid, in its plane of symmetry, and {n:has|have} "
    "the parts of what is nearest.":
        "{n} 个面位于实体内部的对称平面上，取最近处所属的部件。",
    "{n} {n:face runs|faces run} along others as a second skin, such as an outline or an inner wall, and "
    "{n:has|have} their parts.":
        "{n} 个面作为第二层表面（如描边或内壁）沿着其他面延伸，与它们属于相同的部件。",
    "{n} border {n:edge|edges}: the surface is open there.": "{n} 条开放边：表面在此处开放。",
    "{n} {n:vertex belongs to no face; it gets|vertices belong to no face; they get} no part.":
        "{n} 个顶点不属于任何面；它们不归入部件。",
    "{n} {n:face has zero area; it follows its|faces have zero area; they follow their} neighbors.":
        "{n} 个面的面积为零；它们随相邻面归类。",
    "{asked} parts were asked for; there are {n} at most.": "要求 {asked} 个部件；最多有 {n} 个。",
    "{n} coincident border {n:vertex is|vertices are} treated as joined.": "{n} 个重合的开放边顶点视为相连。",
    "{n} faces whose borders run along each other, but do not meet, are treated as joined.":
        "{n} 个面的边界彼此相邻但不重合，视为相连。",
    "{n} {n:triangle faces inwards or against its|triangles face inwards or against their} neighbors.":
        "{n} 个三角形朝内或与相邻面方向相反。",
    "{type} is no mesh: give vertices and faces.": "{type} 不是网格：需要 vertices 和 faces。",
    "{n} {n:number is|numbers are} masked. Leave out the vertices and faces that have them.":
        "{n} 个数值被遮罩。请去掉含有它们的顶点和面。",
    "{n} pieces that touch, or nearly so, form one body; with Pieces: Separate each is decomposed on its own.":
        "{n} 个相互接触或几乎接触的块构成一个整体；“块：各自”会分别分解每一块。",
    "{n} pieces form {bodies} bodies; what touches is decomposed together.":
        "{n} 个块构成 {bodies} 个整体；相互接触的块一起分解。",
    "The rest is decomposed without {n} large plain {n:piece|pieces}, such as a floor.":
        "分解其余部分时不含 {n} 个大而简单的块（如地面）。",
    "{n} small {n:body is one part|bodies are one part each}.": "{n} 个小整体各为一个部件。",
    "{n} of the bodies {n:is|are} so even that nothing protrudes.": "其中 {n} 个整体过于均匀，没有突出部分。",
    "{n} loose parts are decomposed each on its own.": "{n} 个松散块各自单独分解。",
    "{n} loose parts are decomposed each on its own; {small} small {small:one is one|ones are one} part each.":
        "{n} 个松散块各自单独分解；其中 {small} 个小块各为一个部件。",
    "{n} of the loose parts {n:is|are} so even that nothing protrudes.": "其中 {n} 个松散块过于均匀，没有突出部分。",
    "Nothing protrudes: the surface is even.": "没有突出部分：表面过于均匀。",
    "The mesh was decomposed together with its mirror image.": "网格已与其镜像一起分解。",
    "A mirror plane is four numbers: its normal, and its distance from the origin.":
        "镜像平面由四个数字表示：法向及其到原点的距离。",
    "Faces that a Boolean modifier adds to {name} are in no part and have no color.":
        "布尔修改器为 {name} 添加的面不属于任何部件，也没有颜色。",
    "No joints: there is no cut that could have one.": "没有接头：没有可以设接头的切口。",
    "{name} was decomposed as it is before its modifier was applied.": "{name} 按应用其修改器之前的状态分解。",
    "{name} was decomposed as it is before its {n} modifiers were applied.":
        "{name} 按应用其 {n} 个修改器之前的状态分解。",
    "{n} objects share this mesh; all of them show its parts.": "{n} 个物体共用此网格；它们都显示其部件。",
    # 无法分解的情况
    "Select a mesh first": "请先选择一个网格",
    "There is no active object. Select a mesh and try again.": "没有活动物体。请选择一个网格并重试。",
    "{name} is the active object, and not a mesh. Hold Shift and click the mesh.":
        "活动物体 {name} 不是网格。请按住 Shift 点击网格。",
    "{name} is not a mesh but of the type {kind}. Select a mesh and try again.":
        "{name} 不是网格，而是 {kind} 类型。请选择一个网格并重试。",
    "{name} is not a mesh but of the type {kind}. Convert it (Object > Convert > Mesh) and try again.":
        "{name} 不是网格，而是 {kind} 类型。请将其转换（物体 > 转换 > 网格）并重试。",
    "The faces of {name} are made by its modifiers. Apply these (Object > Convert > Mesh) and try again.":
        "{name} 的面由其修改器生成。请应用这些修改器（物体 > 转换 > 网格）并重试。",
    "{name} is a library override and its mesh cannot be written. Make it local (Object > Library Override > Make "
    "Local) and try again.":
        "{name} 是库重写，其网格无法写入。请将其转为本地项（物体 > 库重写 > 转为本地项）并重试。",
    "{name} is linked from {source}, which is not there or does not have it any more. Bring it back and open the file "
    "again.":
        "{name} 关联自 {source}，但该文件不存在或已不包含它。请将其恢复，然后重新打开文件。",
    "{name} is linked from {source} and cannot be written. Make it local (Object > Relations > Make Local) and try "
    "again.":
        "{name} 关联自 {source}，无法写入。请将其转为本地项（物体 > 关系 > 转为本地项）并重试。",
    "another file": "另一个文件",
    "The mesh of {name} is being edited through another object. Leave Edit Mode there first.":
        "{name} 的网格正通过另一个物体进行编辑。请先在那里退出编辑模式。",
    "{name} is being sculpted with dynamic topology, which keeps its own mesh. Switch Dyntopo off, or leave Sculpt "
    "Mode, and try again.":
        "{name} 正在使用动态拓扑雕刻，其网格单独存储。请关闭动态拓扑或退出雕刻模式，然后重试。",
    "The mesh has no faces. Add some, or choose another object.": "网格没有面。请添加一些面，或选择另一个物体。",
    "The mesh has only {n} of the {least} faces that the smallest solid has. Choose a larger mesh.":
        "网格只有 {n} 个面，而最小的实体有 {least} 个面。请选择更大的网格。",
    "All {n} faces have zero area. Check the scale of the object.": "全部 {n} 个面的面积为零。请检查物体的缩放。",
    "{n} of {total} vertices {n:has|have} a coordinate that is not a finite number (first: vertex {first}). Delete or "
    "move them.":
        "{total} 个顶点中有 {n} 个的坐标不是有限数值（首个：顶点 {first}）。请删除或移动它们。",
    "{n} of {total} faces {n:names|name} a vertex that does not exist (first: face {first}; there are {n_vertices} "
    "vertices).":
        "{total} 个面中有 {n} 个引用了不存在的顶点（首个：面 {first}；共有 {n_vertices} 个顶点）。",
    "{n} {n:face has|faces have} fewer than three corners.": "{n} 个面的角点少于三个。",
    "{n} {n:vertex|vertices} cannot be reached from vertex {source}.": "从顶点 {source} 无法到达 {n} 个顶点。",
    "Vertices must have shape (n, 3), not {shape}.": "顶点的形状必须为 (n, 3)，而不是 {shape}。",
    "Triangles must have shape (m, 3), not {shape}.": "三角形的形状必须为 (m, 3)，而不是 {shape}。",
    "Labels must be a row of whole numbers, at least one, not {type} of shape {shape}.":
        "标签必须是一行整数，至少一个，而不是形状为 {shape} 的 {type}。",
    "There are {n} values for {total} elements: each needs one.":
        "有 {n} 个值对应 {total} 个元素：每个元素需要一个值。",
    "There are {n} {name} for {total} parts: each part needs one.":
        "有 {n} 个 {name} 对应 {total} 个部件：每个部件需要一个值。",
    "The parts are of another mesh: give the one that was decomposed.": "部件属于另一个网格：请给出被分解的那个网格。",
    "{name} must be {wanted}, not {type}.":
        "{name} 必须为 {wanted}，而不是 {type}。",
    "{name} must have {n} numbers for each part, as descriptors do.":
        "{name} 必须像描述符那样，每个部件有 {n} 个数。",
    "Neighbors must be pairs of whole numbers from 0 to {last}.":
        "邻接必须为 0 到 {last} 的整数对。",
    "The parts are of another result: give the one that they were read from.":
        "部件属于另一个结果：请给出读取这些部件的那个结果。",
    "{name} must be finite numbers of shape {shape}, not {given}.":
        "{name} 必须为形状 {shape} 的有限数字，而不是 {given}。",
    "Weights must be 0 or more, finite, and not all of them 0.": "权重必须大于或等于 0 且有限，不能全部为 0。",
    "Faces must have shape (m, corners), not {shape}.": "面的形状必须为 (m, 角点)，而不是 {shape}。",
    "Face indices must be whole numbers, not {type}.": "面的编号必须为整数，而不是 {type}。",
    "Labels must be {n} whole numbers from 0, one for each face.": "标签必须为 {n} 个从 0 开始的整数，每个面一个。",
    "Groups must be {n} whole numbers, one for each candidate.": "分组必须为 {n} 个整数，每个候选部件一个。",
    "Numbers must be {n} whole numbers from 1, one for each part.": "编号必须为 {n} 个从 1 开始的整数，每个部件一个。",
    "Colors must be from 0 to 1.": "颜色必须在 0 到 1 之间。",
    "Polygon numbers must be {n} whole numbers from 0, one per triangle.":
        "多边形编号必须是从 0 开始的 {n} 个整数，每个三角形一个。",
    "{name} must be one of {choices}, not {value}.": "{name} 必须是 {choices} 之一，而不是 {value}。",
    "{name} must be a number, not {value}.": "{name} 必须为数字，而不是 {value}。",
    "{name} must be a number from {low} to {high}, not {value}.":
        "{name} 必须为 {low} 到 {high} 之间的数字，而不是 {value}。",
    "{name} must be a whole number from {low} to {high}, not {value}.":
        "{name} 必须为 {low} 到 {high} 之间的整数，而不是 {value}。",
    "The mesh is too large to be measured. Check the scale of the object.": "网格过大，无法测量。请检查物体的缩放。",
    "The stored parts are damaged. Decompose again.": "存储的部件已损坏。请重新分解。",
    "The stored parts were written by Reeb Parts {version}, which is newer than this one. Install that version, or "
    "decompose again.":
        "存储的部件由 Reeb Parts {version} 写入，该版本比当前版本新。请安装该版本，或重新分解。",
    "{name} must be true or false, not {value}.": "{name} 必须为真或假，而不是 {value}。",
    "There is no parameter {name}.": "没有参数 {name}。",
    "Parameters are given by their names, not as {value}.": "参数应按名称给出，而不是 {value}。",
    "Vertices must be rows of three numbers.": "顶点必须是由三个数字组成的行。",
    "{n} {n:face is no row|faces are no rows} of whole numbers (first: face {first}).":
        "{n} 个面不是由整数组成的行（首个：面 {first}）。",
    "There is no preset {name}. Choose one of: {presets}.": "没有预设 {name}。请从以下选择：{presets}。",
    "SciPy, which Reeb Parts computes with, could not be imported ({error}). Install Reeb Parts again; if that does "
    "not help, another extension brings a SciPy that does not fit this Blender.":
        "无法导入 Reeb Parts 用于计算的 SciPy（{error}）。请重新安装 Reeb Parts；如果没有效果，则是另一个扩展带来了不"
        "适合此 Blender 的 SciPy。",
    # 分解的结果
    "Reeb Parts is still computing": "Reeb Parts 仍在计算",
    "{n} {n:part|parts} in {seconds:.1f} s": "{n} 个部件，用时 {seconds:.1f} 秒",
    "Blender stood still, since its Python could not be started beside it":
        "Blender 曾停止响应，因为无法在旁边另行启动其 Python",
    "There is not enough memory to decompose {name} ({n} vertices); nothing was changed. Close other programs, or "
    "decimate a copy and decompose that.":
        "内存不足，无法分解 {name}（{n} 个顶点）；未更改任何内容。请关闭其他程序，或精简一个副本并分解该副本。",
    "There is not enough memory; nothing was changed. Close other programs and try again.":
        "内存不足；未更改任何内容。请关闭其他程序后重试。",
    "The process that decomposed {name} ended unexpectedly ({reason}); nothing was changed. Try again, and report it "
    "if that happens again.":
        "分解 {name} 的进程意外终止（{reason}）；未更改任何内容。请重试；如果再次发生，请报告。",
    "Cancelled; nothing was changed": "已取消；未更改任何内容",
    "{command} was ended with its window; nothing was changed.":
        "{command} 已随其窗口结束；未作任何更改。",
    "What was worked on has been deleted meanwhile; nothing was made.": "处理中的对象已被删除；未生成任何内容。",
    "{name} is gone; its parts were computed in vain.": "{name} 已不存在；其部件的计算结果未被使用。",
    "{name} is not in this scene. Go back to its own, and decompose it again.":
        "{name} 不在此场景中。请回到它所在的场景并重新分解。",
    "{name} was changed while its parts were computed. Decompose it again.":
        "{name} 在计算部件期间被更改。请重新分解。",
    "The active object has no parts": "活动物体没有部件",
    "Decompose the mesh first": "请先分解网格",
    "Select the original, {name}, first.": "请先选择原物体 {name}。",
    "{name} has no parts yet. Decompose it first.": "{name} 还没有部件。请先分解。",
    "{name} is being edited. Leave Edit Mode first.": "{name} 正在编辑。请先退出编辑模式。",
    "{name} was edited since it was decomposed. Decompose it again.": "{name} 在分解之后被编辑过。请重新分解。",
    "The stored parts were written by another version. Decompose again.": "存储的部件由另一个版本写入。请重新分解。",
    # 工具的报告
    "There is no part with the number {number}.": "没有编号为 {number} 的部件。",
    "No other part is like {name}; a larger difference finds more": "没有其他部件与 {name} 相似；增大差值可找到更多",
    "Similar parts: {n}, marked on {objects} {objects:object|objects}": "相似部件：{n} 个，已在 {objects} 个物体上勾选",
    "Parts named: {n}, on {objects} {objects:object|objects}": "已命名部件：{n} 个，在 {objects} 个物体上",
    "No part of {name} has a name of its own. Double-click parts in the list to name them.":
        "{name} 没有自行命名的部件。请在列表中双击部件以命名。",
    "Select other decomposed objects, too; the active one gives the names.":
        "请同时选择其他已分解的物体；名称取自活动物体。",
    "{name} is locked. Unlock it in the list first.": "{name} 已锁定。请先在列表中解锁。",
    "Mark the parts to merge in the list, two or more.": "请在列表中勾选两个或更多要合并的部件。",
    "These parts do not touch each other. Choose parts that do.": "这些部件互不相接。请选择相接的部件。",
    "{n} {n:part is|parts are} {name} now": "{n} 个部件现为 {name}",
    "{name} shares no edge with another part: there is no boundary to move.":
        "{name} 与其他部件没有共享的边：没有可移动的边界。",
    "{name} touches no other part.": "{name} 不与其他部件相接。",
    "No cut was found inside {name}. Select faces in Edit Mode and assign them to another part instead.":
        "在 {name} 内没有找到切口。请改为在编辑模式中选择面，并将其指定给另一个部件。",
    "{new} was cut from {name}": "已从 {name} 切下 {new}",
    "Nothing of {name} would be cut off there. Point at another place.":
        "在此处不会从 {name} 切下任何部分。请指向另一个位置。",
    "Nothing is left around {name} that is not locked.": "{name} 周围没有未锁定的部分。",
    "Nothing is left around {name} that it could take.": "{name} 周围没有可以并入的部分。",
    "{name} cannot give away anything more.": "{name} 无法再让出任何部分。",
    "Nothing would be left of the part. Slide the boundary less far.": "部件将不剩任何部分。请减小边界的滑移距离。",
    "Drag over the model to paint    Ctrl and wheel, [ ]: size    Enter: confirm    Esc: cancel":
        "在模型上拖动以绘制    Ctrl 加滚轮，[ ]：大小    回车：确认    Esc：取消",
    "Click the graph or the surface to cut the part there    Enter, Esc: end":
        "单击图或表面以在该处切割部件    回车、Esc：结束",
    "Click a part or the graph to choose it    Shift: several    Enter, Esc: end":
        "单击部件或图以选择部件    Shift：多选    回车、Esc：结束",
    "This works in Object Mode, where the parts can be seen.": "此操作在物体模式中进行，以便看到部件。",
    "This works over a 3D viewport.": "此操作需在 3D 视图中进行。",
    "The object was changed meanwhile.": "物体在此期间被更改。",
    "No faces were painted.": "没有绘制任何面。",
    "No faces are selected. Select some in Edit Mode.": "没有选择任何面。请在编辑模式中选择一些面。",
    "{n} {n:face is|faces are} {name} now": "{n} 个面现属于 {name}",
    "{n} {n:face is in another part|faces are in other parts} now": "{n} 个面现属于其他部件",
    "The parts are not face sets yet. Press Face Sets, then paint them in Sculpt Mode.":
        "部件还不是面组。请按“面组”，然后在雕刻模式中绘制。",
    "Select a node of a graph": "请选择图的一个节点",
    "Select the arcs of a graph": "请选择图的弧",
    "The active object shows no graph": "活动物体没有显示图",
    "Leave the object's mode first": "请先退出物体的当前模式",
    "Nothing is being computed": "当前没有计算",
    "Go to Object Mode first": "请先进入物体模式",
    "{name}: {n} {n:part is an object|parts are objects} now": "{name}：{n} 个部件现为物体",
    "{n} earlier {n:object that was edited or is needed by others is left as it is|objects that were edited or are "
    "needed by others are left as they are}":
        "{n} 个被编辑过或被其他物体引用的先前物体保持不变",
    "{n} of {total} {total:part|parts} {n:is not closed or crosses itself|are not closed or cross themselves}: {names}":
        "{total} 个部件中有 {n} 个未封闭或自相交：{names}",
    "{n} of {total} {total:part|parts} {n:has|have} faces that look inwards: {names}":
        "{total} 个部件中有 {n} 个含有朝内的面：{names}",
    "{name} is missing from renders of other scenes: {names}":
        "渲染其他场景时不再包含 {name}：{names}",
    "{name} is missing from renders of instances of its collection: {names}":
        "渲染其集合的实例时不再包含 {name}：{names}",
    "{n} of {total} {total:part|parts} {n:is open or crosses itself|are open or cross themselves} as the model does "
    "there: {names}":
        "{total} 个部件中有 {n} 个未封闭或自相交，模型在该处本就如此：{names}",
    "{n} {n:part is closed and does not cross itself|parts are closed and do not cross themselves}":
        "{n} 个部件封闭且无自相交",
    "{name} has nothing of the kind.": "{name} 没有此类内容。",
    "{n} {n:face|faces} selected": "已选择 {n} 个面",
    "Other objects share the mesh of {name}": "其他物体共用 {name} 的网格",
    "Nothing has to be repaired": "没有需要修复的内容",
    "Nothing of {name} can be repaired": "{name} 没有可修复之处",
    "{n} {n:border runs|borders run} along faces: a smooth cut would tear or cross a part there":
        "{n} 条边界沿面分割：平滑切口会在该处撕裂部件或与部件相交",
    "{n} {n:edge stays|edges stay} open: more than two faces meet beside {n:it|them}":
        "{n} 条边保持开放：其旁边有两个以上的面相接",
    "{name} is in another mode than the active object. Go to Object Mode there first.":
        "{name} 与活动物体处于不同的模式。请先在该物体上进入物体模式。",
    "The modifiers of {name} leave no faces, though perhaps instances. Apply them as a mesh and decompose again.":
        "{name} 的修改器没有留下任何面，可能只有实例。请将其应用为网格后重新分解。",
    "{name} is not in this view layer. Include its collection first.": "{name} 不在此视图层中。请先包含其集合。",
    "The effect of {modifiers} is made for all of {name}, and each part takes another shape: use Apply "
    "Modifiers to keep the shape":
        "{modifiers} 的效果是针对整个 {name} 设置的，各部件会变成其他形状：请使用“应用修改器”以保持形状",
    "The effect of {modifiers} depends on the extent of the mesh, which differs for each part of {name}: use Apply "
    "Modifiers to keep the shape":
        "{modifiers} 的效果取决于网格的范围，而 {name} 各部件的范围不同：请使用“应用修改器”以保持形状",
    "{n} border {n:vertex lies on another one but cannot be joined with it|vertices lie on others but cannot be joined "
    "with them}: parts stay open there":
        "{n} 个开放边顶点与其他顶点重合，但无法相连：部件在该处保持开放",
    "The active object is not a part that was separated from another one": "活动物体不是从其他物体分离出的部件",
    "The object that {name} was separated from is not in this file.":
        "{name} 所分离自的物体不在此文件中。",
    "Seams around {n} {n:part|parts}": "{n} 个部件周围的缝合边",
    "The seams are yours alone again": "现在只剩您自己的缝合边",
    "{n} {n:part is a face set|parts are face sets}": "{n} 个部件现为面组",
    "The face sets are yours alone again": "现在只剩您自己的面组",
    "{n} {n:part has a material|parts have materials}": "{n} 个部件有材质",
    "The materials are yours alone again": "现在只剩您自己的材质",
    "The location is not finite. Give one on or beside the model.":
        "位置不是有限数值。请给出模型上或模型旁的位置。",
    "{name} has as many UV maps as Blender allows. Remove one and try again.":
        "{name} 的 UV 贴图数量已达 Blender 上限。请移除一个并重试。",
    "{name}: the UV map {map} was changed by hand and stays": "{name}：UV 贴图 {map} 经手动更改，予以保留",
    "{name}: the colors {attribute} were painted on and stay": "{name}：颜色 {attribute} 经手动绘制，予以保留",
    "{name}: weights of the armature were changed by hand and stay": "{name}：骨架的权重经手动更改，予以保留",
    "Unwrapped into the UV map {name}: areas {low:.1f} to {high:.1f} times their size, {share:.0%} of the faces "
    "within 0.3 to 3; angles {angle:.0f}° off on average":
        "已展开到 UV 贴图 {name}：面积为原来的 {low:.1f} 到 {high:.1f} 倍，{share:.0%} 的面在 0.3 到 3 倍之间；角度平"
        "均偏差 {angle:.0f}°",
    "{n} {n:face is|faces are} mirrored in the UV map": "UV 贴图中有 {n} 个面是镜像的",
    "{n} {n:hull|hulls}": "{n} 个凸壳",
    "There is no folder to write to. Choose one and try again.": "没有可写入的文件夹。请选择一个并重试。",
    "{path} could not be written: {reason}": "无法写入 {path}：{reason}",
    "{path} could not be written: Blender takes names of up to {n} bytes, with all folders.":
        "无法写入 {path}：Blender 的文件名连同所有文件夹最多为 {n} 字节。",
    "{path} could not be written whole. Is the disk full?": "无法完整写入 {path}。磁盘是否已满？",
    "{path} is no file but a folder or a device. Choose another name.":
        "{path} 不是文件，而是文件夹或设备。请选择另一个名称。",
    "{path} is read, and would be written over. Choose another name.":
        "{path} 正在被读取，会被覆盖。请选择另一个名称。",
    "{path} would be written over {other}. Give each file a name of its own.":
        "{path} 会覆盖 {other}。请为每个文件指定单独的名称。",
    "{n} {n:file|files} in {folder}": "{folder} 中有 {n} 个文件",
    "{name} is moved by {rig}, too: the new bones lie where it is at rest":
        "{name} 还由 {rig} 带动：新骨骼位于其静置形状处",
    "{name} has {n} {n:bone|bones}": "{name} 有 {n} 根骨骼",
    "A part needs a name.": "部件需要一个名称。",
    "Rename Part": "重命名部件",
    "Add parts to those that are chosen; a click takes one away again": "将部件加入所选部件；再次单击则移除",
    "Choose and change parts: what is under the pointer is filled and named":
        "选取并更改部件：指针下的部件会被填充并显示名称",
    "Choose the part that you click, or all parts that are seen in a box that you drag; beside parts, other objects":
        "选取所单击的部件，或拖出的框内可见的所有部件；部件之外则选择其他物体",
    "Choose these parts and no others": "只选取这些部件",
    "Give another name to the part under the pointer, or else to the active one":
        "为指针下的部件重命名，否则为活动部件重命名",
    "Hide the faces of the chosen parts, beside those that are hidden": "隐藏所选部件的面，已隐藏的面保持隐藏",
    "Say that a key which would move or delete the object does nothing while the tool is the active one":
        "说明此工具为活动工具时，会移动或删除物体的按键不起作用",
    "Take parts from those that are chosen": "从所选部件中移除部件",
    "The new name of the active part": "活动部件的新名称",
    "This key does nothing to parts. Choose another tool to move or delete the object.":
        "此按键对部件不起作用。要移动或删除物体，请选择其他工具。",
    "All of the boundary of {name}": "{name} 的全部边界",
    "All that was painted is locked. Unlock it in the list first.": "所绘制的面均已锁定。请先在列表中解锁。",
    "All that was painted is {name} already.": "所绘制的面已全部属于 {name}。",
    "Boundary of {name} at {other}": "{name} 与 {other} 的边界",
    "How many rings, negative inwards; 0 for as far as the next crease beyond the weakest stretch":
        "圈数，负数向内；0 表示到最弱一段之外的下一条折痕",
    "How many rings, positive outwards; 0 for as far as the next crease": "圈数，正数向外；0 表示到下一条折痕",
    "Into {name}": "绘入 {name}",
    "Move the boundary of each chosen part inwards, ring by ring": "将每个所选部件的边界逐圈向内移动",
    "Move the boundary of each chosen part outwards, ring by ring": "将每个所选部件的边界逐圈向外移动",
    "Move the mouse left and right to slide it    A: all of it    Enter: confirm    Esc: cancel":
        "左右移动鼠标以滑移    A：全部边界    回车：确认    Esc：取消",
    "Neighbor": "相邻部件",
    "Nothing beyond the boundary can be taken or given: it is locked, or all there is.":
        "边界处没有可取得或让出的面：已锁定，或已是全部。",
    "Number of the part at which the boundary slides; 0 for all of the boundary":
        "边界在其处滑移的部件编号；0 表示全部边界",
    "Rings": "圈数",
    "what is left is in {n} {n:part|parts} more": "剩余部分多分成 {n} 个部件",
    "nothing is left of {names}": "{names} 已全部并入其他部件",
    "what is left of {givers} is in {n} {n:part|parts} more: {names}": "{givers} 的剩余部分多分成 {n} 个部件：{names}",
    "{names} gave away {n} {n:face|faces}": "{names} 让出 {n} 个面",
    "{names} took {n} {n:face|faces}": "{names} 取得 {n} 个面",
    "{n} {n:is locked and stays|are locked and stay}": "{n} 个已锁定，保持不变",
    "{n} {n:does not touch it and is a part of its own|do not touch it and are parts of their own}":
        "{n} 个与其不相接，成为单独的部件",
    "{n} {n:face|faces} of {givers} {n:does|do} not touch {name}: a part apart":
        "{givers} 的 {n} 个面与 {name} 不相接：成为单独的部件",
    "{n} {n:face|faces} of {givers} {n:is|are} {name} now": "{givers} 的 {n} 个面现属于 {name}",
    "{rings} {rings:ring|rings}, {low} to {high}    Wheel or a number: rings, minus inwards    Click, Enter: confirm  "
    "  "
    "Esc: cancel":
        "{rings} 圈，{low} 至 {high}    滚轮或数字：圈数，负数向内    单击、回车：确认    Esc：取消",
    "The pieces of {name} are of other parts than are shown now: separate them again.":
        "{name} 的各块不属于当前显示的部件：请重新分离。",
}
