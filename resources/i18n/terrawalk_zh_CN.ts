<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
    <context>
        <name>AccuracyWords</name>
        <message>
            <source>Height RMSE %1 against the last run (%2 → %3 m).</source>
            <translation>高程 RMSE 较上次 %1（%2 → %3 m）。</translation>
        </message>
    </context>
    <context>
        <name>MapFurniture</name>
        <message>
            <source>Height</source>
            <translation>高程</translation>
        </message>
        <message>
            <source>Height, 1 σ</source>
            <translation>高程 1σ</translation>
        </message>
        <message>
            <source>Density</source>
            <translation>密度</translation>
        </message>
        <message>
            <source>Source</source>
            <translation>来源</translation>
        </message>
        <message>
            <source>Track, speed</source>
            <translation>轨迹：速度</translation>
        </message>
        <message>
            <source>Track, height</source>
            <translation>轨迹：高程</translation>
        </message>
        <message>
            <source>Track, plan 1 σ</source>
            <translation>轨迹：平面 1σ</translation>
        </message>
        <message>
            <source>Track, height 1 σ</source>
            <translation>轨迹：高程 1σ</translation>
        </message>
        <message>
            <source>GNSS fix</source>
            <translation>GNSS 定位状态</translation>
        </message>
        <message>
            <source>errors at marks %1 times as long</source>
            <translation>标志点误差放大 %1 倍</translation>
        </message>
    </context>
    <context>
        <name>MapScene</name>
        <message>
            <source>RTK fixed</source>
            <translation>RTK 固定解</translation>
        </message>
        <message>
            <source>RTK float</source>
            <translation>RTK 浮点解</translation>
        </message>
        <message>
            <source>DGNSS</source>
            <translation>差分</translation>
        </message>
        <message>
            <source>single</source>
            <translation>单点</translation>
        </message>
        <message>
            <source>none</source>
            <translation>无</translation>
        </message>
        <message>
            <source>not told</source>
            <translation>未知</translation>
        </message>
    </context>
    <context>
        <name>PlotData</name>
        <message>
            <source>Fix code</source>
            <translation>定位代码</translation>
        </message>
        <message>
            <source>Fix</source>
            <translation>定位</translation>
        </message>
        <message>
            <source>Ellipsoidal height</source>
            <translation>椭球高</translation>
        </message>
        <message>
            <source>Height</source>
            <translation>高程</translation>
        </message>
        <message>
            <source>Accuracy</source>
            <translation>精度</translation>
        </message>
        <message>
            <source>Plan</source>
            <translation>平面</translation>
        </message>
        <message>
            <source>GNSS velocity</source>
            <translation>GNSS 速度</translation>
        </message>
        <message>
            <source>East</source>
            <translation>东</translation>
        </message>
        <message>
            <source>North</source>
            <translation>北</translation>
        </message>
        <message>
            <source>Up</source>
            <translation>上</translation>
        </message>
        <message>
            <source>Pressure</source>
            <translation>气压</translation>
        </message>
        <message>
            <source>Temperature</source>
            <translation>温度</translation>
        </message>
        <message>
            <source>Optical flow</source>
            <translation>光流</translation>
        </message>
        <message>
            <source>Forward</source>
            <translation>前</translation>
        </message>
        <message>
            <source>Left</source>
            <translation>左</translation>
        </message>
        <message>
            <source>Quality</source>
            <translation>质量</translation>
        </message>
        <message>
            <source>Tilt</source>
            <translation>倾角</translation>
        </message>
        <message>
            <source>Roll</source>
            <translation>横滚</translation>
        </message>
        <message>
            <source>Pitch</source>
            <translation>俯仰</translation>
        </message>
        <message>
            <source>Heading</source>
            <translation>航向</translation>
        </message>
        <message>
            <source>Acceleration</source>
            <translation>加速度</translation>
        </message>
        <message>
            <source>Angular rate</source>
            <translation>角速度</translation>
        </message>
        <message>
            <source>Range to the ground</source>
            <translation>对地测距</translation>
        </message>
        <message>
            <source>Range</source>
            <translation>测距</translation>
        </message>
        <message>
            <source>Strength</source>
            <translation>强度</translation>
        </message>
        <message>
            <source>The log of run %1 has no readings of this sensor.</source>
            <translation>航次 %1 的记录中没有该传感器的读数。</translation>
        </message>
        <message>
            <source>GNSS, as logged</source>
            <translation>GNSS 原始记录</translation>
        </message>
        <message>
            <source>Fused, 95 % band</source>
            <translation>融合结果，95 % 区间</translation>
        </message>
        <message>
            <source>Speed over ground</source>
            <translation>对地速度</translation>
        </message>
        <message>
            <source>Climb</source>
            <translation>升降速度</translation>
        </message>
        <message>
            <source>Position, 1 σ</source>
            <translation>位置 1σ</translation>
        </message>
        <message>
            <source>Attitude, 1 σ</source>
            <translation>姿态 1σ</translation>
        </message>
        <message>
            <source>Height of the ground</source>
            <translation>地面高程</translation>
        </message>
        <message>
            <source>The heights fit the points that are used; those that were refused may lie beyond.</source>
            <translation>高程范围按已用点确定，被剔除的点可能超出。</translation>
        </message>
        <message>
            <source>This run has no ground points: its range finder gave nothing.</source>
            <translation>该航次没有地面点：测距仪无输出。</translation>
        </message>
        <message>
            <source>Mark</source>
            <translation>标志点</translation>
        </message>
        <message>
            <source>Track, tied to the mark</source>
            <translation>轨迹，已与标志点约束</translation>
        </message>
        <message>
            <source>Track</source>
            <translation>轨迹</translation>
        </message>
        <message>
            <source>Surface, mark used by the estimator</source>
            <translation>曲面，标志点参与估计</translation>
        </message>
        <message>
            <source>Surface</source>
            <translation>曲面</translation>
        </message>
        <message>
            <source>%1, error over σ</source>
            <translation>%1，误差 / σ</translation>
        </message>
        <message>
            <source>No errors at marks. Add marks to the survey's control.csv and process again.</source>
            <translation>没有标志点误差。请在 control.csv 中添加标志点并重新处理。</translation>
        </message>
        <message>
            <source>Height error of the surface</source>
            <translation>曲面高程误差</translation>
        </message>
        <message>
            <source>Height error of the tracks</source>
            <translation>轨迹高程误差</translation>
        </message>
        <message>
            <source>Marks</source>
            <translation>标志点</translation>
        </message>
        <message>
            <source>Normal, of the same mean and SD</source>
            <translation>同均值同标准差的正态分布</translation>
        </message>
        <message>
            <source>n %1, mean %2, SD %3, RMSE %4</source>
            <translation>n %1，均值 %2，标准差 %3，RMSE %4</translation>
        </message>
        <message>
            <source>Normal, of the same median and NMAD</source>
            <translation>同中位数同 NMAD 的正态分布</translation>
        </message>
        <message>
            <source>Quantile of the normal distribution (σ)</source>
            <translation>正态分布分位数 (σ)</translation>
        </message>
        <message>
            <source>n %1, median %2, NMAD %3. Ends that leave the line are heavier than normal.</source>
            <translation>n %1，中位数 %2，NMAD %3。两端偏离直线表示尾部比正态更重。</translation>
        </message>
        <message>
            <source>Method, best first</source>
            <translation>方法，最优在前</translation>
        </message>
        <message>
            <source>Error of points left out, RMSE</source>
            <translation>留出点误差 RMSE</translation>
        </message>
        <message>
            <source>Points foretold from the others. Used: %1. Seed %2.</source>
            <translation>由其余点预测留出点。采用：%1。种子 %2。</translation>
        </message>
        <message>
            <source>Nothing was tuned. Tune the survey on its own marks to compare here.</source>
            <translation>未调参。用标志点调参后可在此比较。</translation>
        </message>
        <message>
            <source>on its marks</source>
            <translation>在其标志点上</translation>
        </message>
        <message>
            <source>Loss</source>
            <translation>损失</translation>
        </message>
        <message>
            <source>Before</source>
            <translation>之前</translation>
        </message>
        <message>
            <source>After</source>
            <translation>之后</translation>
        </message>
        <message>
            <source>on marks left out</source>
            <translation>在留出的标志点上</translation>
        </message>
        <message>
            <source>%1, %2 evaluations, seed %3.</source>
            <translation>%1，评估 %2 次，种子 %3。</translation>
        </message>
        <message>
            <source>Process the survey to see this.</source>
            <translation>处理测量后可查看。</translation>
        </message>
        <message>
            <source>GNSS position</source>
            <translation>GNSS 位置</translation>
        </message>
        <message>
            <source>Barometer</source>
            <translation>气压计</translation>
        </message>
        <message>
            <source>Attitude</source>
            <translation>姿态</translation>
        </message>
        <message>
            <source>Range finder</source>
            <translation>测距仪</translation>
        </message>
        <message>
            <source>Position</source>
            <translation>位置</translation>
        </message>
        <message>
            <source>Speed</source>
            <translation>速度</translation>
        </message>
        <message>
            <source>Sigmas</source>
            <translation>σ</translation>
        </message>
        <message>
            <source>Ground points</source>
            <translation>地面点</translation>
        </message>
        <message>
            <source>Errors over sigma</source>
            <translation>误差与 σ 之比</translation>
        </message>
        <message>
            <source>Histogram of errors</source>
            <translation>误差直方图</translation>
        </message>
        <message>
            <source>Q-Q of errors</source>
            <translation>误差 Q-Q 图</translation>
        </message>
        <message>
            <source>Cross-validation</source>
            <translation>交叉验证</translation>
        </message>
        <message>
            <source>Tuning</source>
            <translation>调参</translation>
        </message>
        <message>
            <source>Sensors</source>
            <translation>传感器</translation>
        </message>
        <message>
            <source>Fused run</source>
            <translation>融合航次</translation>
        </message>
        <message>
            <source>Errors at marks</source>
            <translation>标志点误差</translation>
        </message>
        <message>
            <source>Choices</source>
            <translation>选择</translation>
        </message>
        <message>
            <source>%1, run %2</source>
            <translation>%1，航次 %2</translation>
        </message>
        <message>
            <source>Time of the log</source>
            <translation>记录时间</translation>
        </message>
        <message>
            <source>The method that was used has no filter that foretells readings. Choose another one and process again.</source>
            <translation>所用方法没有预测读数的滤波器。请选择其他方法并重新处理。</translation>
        </message>
        <message>
            <source>used</source>
            <translation>已用</translation>
        </message>
        <message>
            <source>beyond the gate</source>
            <translation>超出门限</translation>
        </message>
        <message>
            <source>Reading less what the filter foretold, over the sigma of that: 95 % between the lines is right.</source>
            <translation>读数减滤波预测，除以其 σ：95 % 落在两线之间为正常。</translation>
        </message>
        <message>
            <source>Mean NIS over its degrees of freedom</source>
            <translation>平均 NIS 除以自由度</translation>
        </message>
        <message>
            <source>Sensor (readings used)</source>
            <translation>传感器（使用读数）</translation>
        </message>
        <message>
            <source>Mean NIS over degrees of freedom</source>
            <translation>平均 NIS / 自由度</translation>
        </message>
        <message>
            <source>right</source>
            <translation>正常</translation>
        </message>
        <message>
            <source>Normalised innovations squared. Above 1 the filter is too sure of this sensor, below 1 not sure enough; gates and weights make it smaller.</source>
            <translation>归一化新息平方。大于 1 表示滤波器对该传感器过于自信，小于 1 表示信心不足；门限和降权会使其变小。</translation>
        </message>
        <message>
            <source>%1 of %2 errors lie within 1.96 σ (%3 %); 95 % is right. Marks that the estimator used do not count.</source>
            <translation>%2 个误差中有 %1 个在 1.96 σ 以内（%3 %），95 % 为正常。参与估计的标志点不计。</translation>
        </message>
        <message>
            <source>Too few marks to show how errors spread: three at least, that the estimator did not use.</source>
            <translation>标志点太少，无法显示误差分布：至少需要三个未参与估计的标志点。</translation>
        </message>
        <message>
            <source>Ways of interpolating were not compared. Set the surface's method to auto and process again.</source>
            <translation>未比较内插方法。请将曲面方法设为 auto 并重新处理。</translation>
        </message>
        <message>
            <source>Innovations</source>
            <translation>新息</translation>
        </message>
        <message>
            <source>Consistency (NIS)</source>
            <translation>一致性 (NIS)</translation>
        </message>
    </context>
    <context>
        <name>ProfilePlot</name>
        <message>
            <source>Profile</source>
            <translation>剖面</translation>
        </message>
        <message>
            <source>Along the line</source>
            <translation>沿线距离</translation>
        </message>
        <message>
            <source>Surface, 95 % band</source>
            <translation>曲面，95 % 区间</translation>
        </message>
        <message>
            <source>There is no surface along this line.</source>
            <translation>沿此线没有曲面。</translation>
        </message>
        <message>
            <source>Marks beside it</source>
            <translation>线旁标志点</translation>
        </message>
        <message>
            <source>Height</source>
            <translation>高程</translation>
        </message>
    </context>
    <context>
        <name>RasterPicture</name>
        <message>
            <source>measured</source>
            <translation>实测</translation>
        </message>
        <message>
            <source>points/m²</source>
            <translation>点/m²</translation>
        </message>
        <message>
            <source>interpolated</source>
            <translation>内插</translation>
        </message>
        <message>
            <source>extrapolated</source>
            <translation>外推</translation>
        </message>
    </context>
    <context>
        <name>Report</name>
        <message>
            <source>before fusion</source>
            <translation>融合前</translation>
        </message>
        <message>
            <source>fused</source>
            <translation>融合后</translation>
        </message>
        <message>
            <source>surface</source>
            <translation>曲面</translation>
        </message>
        <message>
            <source>position on mark</source>
            <translation>标志点处位置</translation>
        </message>
        <message>
            <source>nearest ground point</source>
            <translation>最近地面点</translation>
        </message>
        <message>
            <source>surface height</source>
            <translation>曲面高程</translation>
        </message>
        <message>
            <source>control</source>
            <translation>控制</translation>
        </message>
        <message>
            <source>check</source>
            <translation>检核</translation>
        </message>
        <message>
            <source>Height error (RMSE)</source>
            <translation>高程误差 (RMSE)</translation>
        </message>
        <message>
            <source>Height error of the surface (RMSE)</source>
            <translation>曲面高程误差 (RMSE)</translation>
        </message>
        <message>
            <source>Height error of the track (RMSE)</source>
            <translation>轨迹高程误差 (RMSE)</translation>
        </message>
        <message>
            <source>Check marks compared</source>
            <translation>参与比较的检核点</translation>
        </message>
        <message>
            <source>Terrain model</source>
            <translation>地形模型</translation>
        </message>
        <message>
            <source>not known</source>
            <translation>未知</translation>
        </message>
        <message>
            <source>used</source>
            <translation>已用</translation>
        </message>
        <message>
            <source>no range</source>
            <translation>无测距</translation>
        </message>
        <message>
            <source>range too short</source>
            <translation>测距过短</translation>
        </message>
        <message>
            <source>range too long</source>
            <translation>测距过长</translation>
        </message>
        <message>
            <source>weak return</source>
            <translation>回波弱</translation>
        </message>
        <message>
            <source>saturated</source>
            <translation>饱和</translation>
        </message>
        <message>
            <source>tilted</source>
            <translation>倾斜</translation>
        </message>
        <message>
            <source>position unsure</source>
            <translation>位置不可靠</translation>
        </message>
        <message>
            <source>spike</source>
            <translation>突跳</translation>
        </message>
        <message>
            <source>thinned</source>
            <translation>抽稀</translation>
        </message>
        <message>
            <source>run left out</source>
            <translation>航次排除</translation>
        </message>
        <message>
            <source>statistical outlier</source>
            <translation>统计离群</translation>
        </message>
        <message>
            <source>isolated</source>
            <translation>孤立</translation>
        </message>
        <message>
            <source>above ground</source>
            <translation>高于地面</translation>
        </message>
    </context>
    <context>
        <name>Steps</name>
        <message>
            <source>Import</source>
            <translation>导入</translation>
        </message>
        <message>
            <source>Tune</source>
            <translation>调参</translation>
        </message>
        <message>
            <source>Fuse</source>
            <translation>融合</translation>
        </message>
        <message>
            <source>Method</source>
            <translation>方法</translation>
        </message>
        <message>
            <source>GNSS heights</source>
            <translation>GNSS 高程</translation>
        </message>
        <message>
            <source>Barometer</source>
            <translation>气压计</translation>
        </message>
        <message>
            <source>Optical flow</source>
            <translation>光流</translation>
        </message>
        <message>
            <source>Clean</source>
            <translation>清理</translation>
        </message>
        <message>
            <source>Longest range</source>
            <translation>最大测距</translation>
        </message>
        <message>
            <source>Drop outliers</source>
            <translation>剔除离群点</translation>
        </message>
        <message>
            <source>Drop plants</source>
            <translation>剔除植被</translation>
        </message>
        <message>
            <source>Surface</source>
            <translation>曲面</translation>
        </message>
        <message>
            <source>Cell size</source>
            <translation>格网大小</translation>
        </message>
        <message>
            <source>Terrace edges</source>
            <translation>梯田边缘</translation>
        </message>
        <message>
            <source>Check</source>
            <translation>检核</translation>
        </message>
        <message>
            <source>Export</source>
            <translation>导出</translation>
        </message>
    </context>
    <context>
        <name>TerrainFurniture</name>
        <message>
            <source>Heights as they are</source>
            <translation>高程未夸大</translation>
        </message>
        <message>
            <source>Heights %1</source>
            <translation>高程 %1</translation>
        </message>
        <message>
            <source>, contours every %1</source>
            <translation>，等高距 %1</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::AccuracyModel</name>
        <message>
            <source>Stage</source>
            <translation>阶段</translation>
        </message>
        <message>
            <source>Compared</source>
            <translation>比较对象</translation>
        </message>
        <message>
            <source>Marks</source>
            <translation>标志点</translation>
        </message>
        <message>
            <source>n</source>
            <translation>n</translation>
        </message>
        <message>
            <source>Plan RMSE</source>
            <translation>平面 RMSE</translation>
        </message>
        <message>
            <source>Height mean</source>
            <translation>高程均值</translation>
        </message>
        <message>
            <source>SD</source>
            <translation>标准差</translation>
        </message>
        <message>
            <source>RMSE</source>
            <translation>RMSE</translation>
        </message>
        <message>
            <source>Largest</source>
            <translation>最大</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::AccuracyPanel</name>
        <message>
            <source>Nothing to judge yet. Process the survey: its errors at the marks will stand here.</source>
            <translation>尚无可评价的结果。请先处理测量，标志点处的误差将显示在这里。</translation>
        </message>
        <message>
            <source>Errors by group, in metres</source>
            <translation>分组误差（米）</translation>
        </message>
        <message>
            <source>Surface less mark, the largest first</source>
            <translation>曲面减标志点，由大到小</translation>
        </message>
        <message>
            <source>What the marks say</source>
            <translation>标志点的结论</translation>
        </message>
        <message>
            <source>What could not be checked</source>
            <translation>未能检核的内容</translation>
        </message>
        <message>
            <source>Warnings</source>
            <translation>警告</translation>
        </message>
        <message>
            <source>Mark</source>
            <translation>标志点</translation>
        </message>
        <message>
            <source>Role</source>
            <translation>用途</translation>
        </message>
        <message>
            <source>Height error (m)</source>
            <translation>高程误差 (m)</translation>
        </message>
        <message>
            <source>Predicted σ (m)</source>
            <translation>预测 σ (m)</translation>
        </message>
        <message>
            <source>Error / σ</source>
            <translation>误差 / σ</translation>
        </message>
        <message>
            <source>control</source>
            <translation>控制</translation>
        </message>
        <message>
            <source>check</source>
            <translation>检核</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::ExportDialog</name>
        <message>
            <source>Export the results</source>
            <translation>导出结果</translation>
        </message>
        <message>
            <source>Folder for DEM, uncertainty, mesh, tracks, points and report</source>
            <translation>存放 DEM、不确定度、网格、轨迹、点和报告的文件夹</translation>
        </message>
        <message>
            <source>Folder</source>
            <translation>文件夹</translation>
        </message>
        <message>
            <source>Browse…</source>
            <translation>浏览…</translation>
        </message>
        <message>
            <source>Folder for the results</source>
            <translation>结果文件夹</translation>
        </message>
        <message>
            <source>Further formats, into a folder beside it</source>
            <translation>其他格式，存入旁边的文件夹</translation>
        </message>
        <message>
            <source>The same on the command line</source>
            <translation>等效的命令行</translation>
        </message>
        <message>
            <source>Copy command</source>
            <translation>复制命令</translation>
        </message>
        <message>
            <source>Export</source>
            <translation>导出</translation>
        </message>
        <message>
            <source>Name a folder.</source>
            <translation>请填写文件夹。</translation>
        </message>
        <message>
            <source>This is a file: name a folder.</source>
            <translation>这是一个文件，请填写文件夹。</translation>
        </message>
        <message>
            <source>%1 does not exist: make it first, or choose another place.</source>
            <translation>%1 不存在：请先创建，或选择其他位置。</translation>
        </message>
        <message>
            <source>You may not write there: choose another place.</source>
            <translation>没有写入权限：请选择其他位置。</translation>
        </message>
        <message>
            <source>An earlier export there is replaced in one step.</source>
            <translation>该处以前的导出结果将被一次性替换。</translation>
        </message>
        <message>
            <source>Points, LAS 1.4</source>
            <translation>点，LAS 1.4</translation>
        </message>
        <message>
            <source>Points, PLY</source>
            <translation>点，PLY</translation>
        </message>
        <message>
            <source>Points, PCD</source>
            <translation>点，PCD</translation>
        </message>
        <message>
            <source>Points, CSV</source>
            <translation>点，CSV</translation>
        </message>
        <message>
            <source>Points, GeoPackage</source>
            <translation>点，GeoPackage</translation>
        </message>
        <message>
            <source>Mesh, STL</source>
            <translation>网格，STL</translation>
        </message>
        <message>
            <source>Mesh, LandXML</source>
            <translation>网格，LandXML</translation>
        </message>
        <message>
            <source>Mesh, DXF</source>
            <translation>网格，DXF</translation>
        </message>
        <message>
            <source>DEM, ESRI ASCII</source>
            <translation>DEM，ESRI ASCII</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::MainWindow</name>
        <message>
            <source>Surveys (*.json);;All files (*)</source>
            <translation>测量项目 (*.json);;所有文件 (*)</translation>
        </message>
        <message>
            <source>Settings (*.json);;All files (*)</source>
            <translation>设置 (*.json);;所有文件 (*)</translation>
        </message>
        <message>
            <source>Map</source>
            <translation>地图</translation>
        </message>
        <message>
            <source>Accuracy</source>
            <translation>精度</translation>
        </message>
        <message>
            <source>Survey</source>
            <translation>测量</translation>
        </message>
        <message>
            <source>Messages</source>
            <translation>消息</translation>
        </message>
        <message>
            <source>Place</source>
            <translation>位置</translation>
        </message>
        <message>
            <source>Steps</source>
            <translation>步骤</translation>
        </message>
        <message>
            <source>&amp;Survey</source>
            <translation>测量(&amp;S)</translation>
        </message>
        <message>
            <source>&amp;Open…</source>
            <translation>打开(&amp;O)…</translation>
        </message>
        <message>
            <source>Open &amp;recent</source>
            <translation>最近打开(&amp;R)</translation>
        </message>
        <message>
            <source>None yet</source>
            <translation>暂无</translation>
        </message>
        <message>
            <source>&amp;Start page</source>
            <translation>起始页(&amp;S)</translation>
        </message>
        <message>
            <source>&amp;Save settings</source>
            <translation>保存设置(&amp;S)</translation>
        </message>
        <message>
            <source>&amp;Load settings…</source>
            <translation>载入设置(&amp;L)…</translation>
        </message>
        <message>
            <source>Load settings</source>
            <translation>载入设置</translation>
        </message>
        <message>
            <source>&amp;Process</source>
            <translation>处理(&amp;P)</translation>
        </message>
        <message>
            <source>&amp;Cancel</source>
            <translation>取消(&amp;C)</translation>
        </message>
        <message>
            <source>&amp;Tune on the marks</source>
            <translation>用标志点调参(&amp;T)</translation>
        </message>
        <message>
            <source>&amp;Export…</source>
            <translation>导出(&amp;E)…</translation>
        </message>
        <message>
            <source>Copy as co&amp;mmand</source>
            <translation>复制为命令(&amp;M)</translation>
        </message>
        <message>
            <source>&amp;Quit</source>
            <translation>退出(&amp;Q)</translation>
        </message>
        <message>
            <source>&amp;Edit</source>
            <translation>编辑(&amp;E)</translation>
        </message>
        <message>
            <source>&amp;Undo</source>
            <translation>撤销(&amp;U)</translation>
        </message>
        <message>
            <source>&amp;Redo</source>
            <translation>重做(&amp;R)</translation>
        </message>
        <message>
            <source>E&amp;xclude what is selected</source>
            <translation>排除所选(&amp;X)</translation>
        </message>
        <message>
            <source>Exclude &amp;only</source>
            <translation>仅排除(&amp;O)</translation>
        </message>
        <message>
            <source>range (no ground points)</source>
            <translation>测距（不产生地面点）</translation>
        </message>
        <message>
            <source>GNSS</source>
            <translation>GNSS</translation>
        </message>
        <message>
            <source>barometer</source>
            <translation>气压计</translation>
        </message>
        <message>
            <source>optical flow</source>
            <translation>光流</translation>
        </message>
        <message>
            <source>attitude</source>
            <translation>姿态</translation>
        </message>
        <message>
            <source>&amp;View</source>
            <translation>视图(&amp;V)</translation>
        </message>
        <message>
            <source>&amp;Dark or light</source>
            <translation>深色或浅色(&amp;D)</translation>
        </message>
        <message>
            <source>中文 / English</source>
            <translation>中文 / English</translation>
        </message>
        <message>
            <source>&amp;Help</source>
            <translation>帮助(&amp;H)</translation>
        </message>
        <message>
            <source>&amp;Keys</source>
            <translation>快捷键(&amp;K)</translation>
        </message>
        <message>
            <source>&amp;What is this?</source>
            <translation>这是什么？(&amp;W)</translation>
        </message>
        <message>
            <source>&amp;About Terrawalk</source>
            <translation>关于 Terrawalk(&amp;A)</translation>
        </message>
        <message>
            <source>working</source>
            <translation>处理中</translation>
        </message>
        <message>
            <source>not processed</source>
            <translation>未处理</translation>
        </message>
        <message>
            <source>settings changed: process again</source>
            <translation>设置已更改：请重新处理</translation>
        </message>
        <message>
            <source>up to date</source>
            <translation>结果为最新</translation>
        </message>
        <message>
            <source>Cancel what is running first.</source>
            <translation>请先取消正在运行的任务。</translation>
        </message>
        <message>
            <source>Open a survey</source>
            <translation>打开测量</translation>
        </message>
        <message>
            <source>Copied: %1</source>
            <translation>已复制：%1</translation>
        </message>
        <message>
            <source>Tuned values travel in a file: save the settings, then copy again.</source>
            <translation>调参结果保存在文件中：请先保存设置，再复制。</translation>
        </message>
        <message>
            <source>%1[*] – Terrawalk</source>
            <translation>%1[*] – Terrawalk</translation>
        </message>
        <message>
            <source>Terrawalk</source>
            <translation>Terrawalk</translation>
        </message>
        <message>
            <source>draw a line</source>
            <translation>绘制线</translation>
        </message>
        <message>
            <source>Line drawn: process again, and the surface keeps to it.</source>
            <translation>线已绘制：重新处理后曲面将遵循它。</translation>
        </message>
        <message>
            <source>exclude a stretch</source>
            <translation>排除一段</translation>
        </message>
        <message>
            <source>%1 is left out from %2 to %3 s: process again to see what it changes.</source>
            <translation>%1 的 %2 至 %3 秒已排除：重新处理以查看变化。</translation>
        </message>
        <message>
            <source>leave out %1</source>
            <translation>排除 %1</translation>
        </message>
        <message>
            <source>take %1 back in</source>
            <translation>恢复 %1</translation>
        </message>
        <message>
            <source>Take back in</source>
            <translation>恢复</translation>
        </message>
        <message>
            <source>Leave out</source>
            <translation>排除</translation>
        </message>
        <message>
            <source>Take back</source>
            <translation>撤回</translation>
        </message>
        <message>
            <source>take back an edit</source>
            <translation>撤回一次编辑</translation>
        </message>
        <message>
            <source>About Terrawalk</source>
            <translation>关于 Terrawalk</translation>
        </message>
        <message>
            <source>&lt;h3&gt;Terrawalk %1&lt;/h3&gt;&lt;p&gt;From a walk with the sensor array to a terrain model that you can sign for.&lt;/p&gt;&lt;p&gt;Free software, see LICENSE. Built with Eigen, CGAL, PCL, GDAL, PROJ, OctoMap and Qt.&lt;/p&gt;</source>
            <translation>&lt;h3&gt;Terrawalk %1&lt;/h3&gt;&lt;p&gt;手持传感器阵列走一圈，得到可以签字的地形模型。&lt;/p&gt;&lt;p&gt;自由软件，见 LICENSE。基于 Eigen、CGAL、PCL、GDAL、PROJ、OctoMap 和 Qt。&lt;/p&gt;</translation>
        </message>
        <message>
            <source>3-D</source>
            <translation>三维</translation>
        </message>
        <message>
            <source>Plots</source>
            <translation>图表</translation>
        </message>
        <message>
            <source>Profile</source>
            <translation>剖面</translation>
        </message>
        <message>
            <source>Process the survey first: a profile needs a surface.</source>
            <translation>请先处理测量：剖面需要曲面。</translation>
        </message>
        <message>
            <source>Report</source>
            <translation>报告</translation>
        </message>
        <message>
            <source>Saved to %1.</source>
            <translation>已保存到 %1。</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::MapPanel</name>
        <message>
            <source>Map</source>
            <translation>地图</translation>
        </message>
        <message>
            <source>Layer</source>
            <translation>图层</translation>
        </message>
        <message>
            <source>What the ground is coloured by</source>
            <translation>地面按什么着色</translation>
        </message>
        <message>
            <source>Shaded heights</source>
            <translation>晕渲高程</translation>
        </message>
        <message>
            <source>Uncertainty</source>
            <translation>不确定度</translation>
        </message>
        <message>
            <source>Point density</source>
            <translation>点密度</translation>
        </message>
        <message>
            <source>Source of heights</source>
            <translation>高程来源</translation>
        </message>
        <message>
            <source>No ground</source>
            <translation>不显示地面</translation>
        </message>
        <message>
            <source>Colour of the tracks</source>
            <translation>轨迹颜色</translation>
        </message>
        <message>
            <source>What the tracks are coloured by</source>
            <translation>轨迹按什么着色</translation>
        </message>
        <message>
            <source>Tracks by run</source>
            <translation>轨迹按航次</translation>
        </message>
        <message>
            <source>Tracks by fix</source>
            <translation>轨迹按定位状态</translation>
        </message>
        <message>
            <source>Tracks by speed</source>
            <translation>轨迹按速度</translation>
        </message>
        <message>
            <source>Tracks by height</source>
            <translation>轨迹按高程</translation>
        </message>
        <message>
            <source>Tracks by plan σ</source>
            <translation>轨迹按平面 σ</translation>
        </message>
        <message>
            <source>Tracks by height σ</source>
            <translation>轨迹按高程 σ</translation>
        </message>
        <message>
            <source>Contours</source>
            <translation>等高线</translation>
        </message>
        <message>
            <source>Contours of the surface</source>
            <translation>曲面的等高线</translation>
        </message>
        <message>
            <source>Move and ask</source>
            <translation>移动和查询</translation>
        </message>
        <message>
            <source>Drag moves the map; a click tells what is there.</source>
            <translation>拖动移动地图，单击查询该处。</translation>
        </message>
        <message>
            <source>Select a stretch</source>
            <translation>选择一段</translation>
        </message>
        <message>
            <source>Drag along a track, then exclude what was selected.</source>
            <translation>沿轨迹拖动，然后排除所选部分。</translation>
        </message>
        <message>
            <source>Measure</source>
            <translation>量测</translation>
        </message>
        <message>
            <source>Click points; length and area stand beside them. A double click ends it.</source>
            <translation>单击各点，旁边显示长度和面积，双击结束。</translation>
        </message>
        <message>
            <source>Profile</source>
            <translation>剖面</translation>
        </message>
        <message>
            <source>Click a line; a double click shows the heights along it.</source>
            <translation>单击画线，双击显示沿线高程。</translation>
        </message>
        <message>
            <source>Draw a breakline</source>
            <translation>绘制断裂线</translation>
        </message>
        <message>
            <source>Click along an edge where the surface folds; a double click ends it.</source>
            <translation>沿曲面转折的边缘单击，双击结束。</translation>
        </message>
        <message>
            <source>Draw a soft breakline</source>
            <translation>绘制软断裂线</translation>
        </message>
        <message>
            <source>Triangles keep to it, and the surface stays smooth across it.</source>
            <translation>三角形遵循它，曲面跨线保持光滑。</translation>
        </message>
        <message>
            <source>Draw the boundary</source>
            <translation>绘制边界</translation>
        </message>
        <message>
            <source>Nothing outside it is ground.</source>
            <translation>边界以外不是地面。</translation>
        </message>
        <message>
            <source>Draw a hole</source>
            <translation>绘制空洞</translation>
        </message>
        <message>
            <source>Nothing inside it is ground, e.g. a pond.</source>
            <translation>其内不是地面，例如池塘。</translation>
        </message>
        <message>
            <source>Show all (Home)</source>
            <translation>显示全部 (Home)</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::MapView</name>
        <message>
            <source>Map</source>
            <translation>地图</translation>
        </message>
        <message>
            <source>E %1 m   N %2 m</source>
            <translation>E %1 m   N %2 m</translation>
        </message>
        <message>
            <source>   height %1 m</source>
            <translation>   高程 %1 m</translation>
        </message>
        <message>
            <source>, area %1 m²</source>
            <translation>，面积 %1 m²</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::PlacePanel</name>
        <message>
            <source>a point lies in this cell</source>
            <translation>此格内有点</translation>
        </message>
        <message>
            <source>between points</source>
            <translation>点与点之间</translation>
        </message>
        <message>
            <source>far from any point</source>
            <translation>远离任何点</translation>
        </message>
        <message>
            <source>Where the uncertainty comes from</source>
            <translation>不确定度的来源</translation>
        </message>
        <message>
            <source>Height of the track</source>
            <translation>轨迹高程</translation>
        </message>
        <message>
            <source>Track in plan × slope</source>
            <translation>轨迹平面误差 × 坡度</translation>
        </message>
        <message>
            <source>Attitude × range × slope</source>
            <translation>姿态 × 测距 × 坡度</translation>
        </message>
        <message>
            <source>Between points, noise</source>
            <translation>点间内插与噪声</translation>
        </message>
        <message>
            <source>Nearest hits</source>
            <translation>最近的测距点</translation>
        </message>
        <message>
            <source>Run, time</source>
            <translation>航次，时间</translation>
        </message>
        <message>
            <source>away</source>
            <translation>距离</translation>
        </message>
        <message>
            <source>height</source>
            <translation>高程</translation>
        </message>
        <message>
            <source>σ</source>
            <translation>σ</translation>
        </message>
        <message>
            <source>%1 %2 s</source>
            <translation>%1 %2 s</translation>
        </message>
        <message>
            <source>Click the map: this panel tells the height there, how sure it is, and why.</source>
            <translation>单击地图：此处显示该点高程、可靠程度及原因。</translation>
        </message>
        <message>
            <source>no surface</source>
            <translation>无曲面</translation>
        </message>
        <message>
            <source>E %1, N %2</source>
            <translation>E %1，N %2</translation>
        </message>
        <message>
            <source> · slope %1° · %2 m to the nearest point · %3 points/m² · %4</source>
            <translation> · 坡度 %1° · 距最近点 %2 m · %3 点/m² · %4</translation>
        </message>
        <message>
            <source>Nobody walked here: there is no surface.</source>
            <translation>这里没有走过：没有曲面。</translation>
        </message>
        <message>
            <source>There is no surface here: the nearest hit lies %1 away.</source>
            <translation>这里没有曲面：最近的测距点在 %1 以外。</translation>
        </message>
        <message>
            <source>The survey has too few points to tell how sure this height is.</source>
            <translation>点太少，无法判断该高程的可靠程度。</translation>
        </message>
        <message>
            <source>the height of the track</source>
            <translation>轨迹高程</translation>
        </message>
        <message>
            <source>the track's error in plan, on this slope</source>
            <translation>坡面上的轨迹平面误差</translation>
        </message>
        <message>
            <source>the direction of the ray, on this slope</source>
            <translation>坡面上的光束方向误差</translation>
        </message>
        <message>
            <source>the way between the points</source>
            <translation>点间内插</translation>
        </message>
        <message>
            <source>Most of it is %1 (%2).</source>
            <translation>主要来自%1（%2）。</translation>
        </message>
        <message>
            <source>One more pass here would bring %1 down to about %2.</source>
            <translation>再走一遍可将 %1 降到约 %2。</translation>
        </message>
        <message>
            <source>One more pass here would hardly help.</source>
            <translation>再走一遍帮助不大。</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::PlotsView</name>
        <message>
            <source>All readings</source>
            <translation>全部读数</translation>
        </message>
        <message>
            <source>GNSS</source>
            <translation>GNSS</translation>
        </message>
        <message>
            <source>Barometer</source>
            <translation>气压计</translation>
        </message>
        <message>
            <source>Optical flow</source>
            <translation>光流</translation>
        </message>
        <message>
            <source>Attitude</source>
            <translation>姿态</translation>
        </message>
        <message>
            <source>Range finder</source>
            <translation>测距仪</translation>
        </message>
        <message>
            <source>Plots</source>
            <translation>图表</translation>
        </message>
        <message>
            <source>List of plots</source>
            <translation>图表列表</translation>
        </message>
        <message>
            <source>Run</source>
            <translation>航次</translation>
        </message>
        <message>
            <source>The run that is plotted</source>
            <translation>绘制的航次</translation>
        </message>
        <message>
            <source>Readings to exclude</source>
            <translation>要排除的读数</translation>
        </message>
        <message>
            <source>Which readings of the stretch are left out</source>
            <translation>排除该段的哪些读数</translation>
        </message>
        <message>
            <source>Exclude this stretch</source>
            <translation>排除此段</translation>
        </message>
        <message>
            <source>Values under the cursor</source>
            <translation>光标处的值</translation>
        </message>
        <message>
            <source>Run %1</source>
            <translation>航次 %1</translation>
        </message>
        <message>
            <source>Open a survey to see its plots here.</source>
            <translation>打开测量后在此查看图表。</translation>
        </message>
        <message>
            <source>Leaves these readings of %1, %2 s to %3 s, out of the next run</source>
            <translation>下次处理将排除 %1 从 %2 s 到 %3 s 的这些读数</translation>
        </message>
        <message>
            <source>Drag along the time axis to select a stretch first</source>
            <translation>请先沿时间轴拖动以选择一段</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::PointCard</name>
        <message>
            <source>measured</source>
            <translation>实测</translation>
        </message>
        <message>
            <source>interpolated</source>
            <translation>内插</translation>
        </message>
        <message>
            <source>extrapolated</source>
            <translation>外推</translation>
        </message>
        <message>
            <source>not known</source>
            <translation>未知</translation>
        </message>
        <message>
            <source>1 σ</source>
            <translation>1 σ</translation>
        </message>
        <message>
            <source>Density</source>
            <translation>密度</translation>
        </message>
        <message>
            <source>%1 points/m²</source>
            <translation>%1 点/m²</translation>
        </message>
        <message>
            <source>Source</source>
            <translation>来源</translation>
        </message>
        <message>
            <source>Height %1</source>
            <translation>高程 %1</translation>
        </message>
        <message>
            <source>Nearest sample</source>
            <translation>最近样点</translation>
        </message>
        <message>
            <source>%1 away</source>
            <translation>相距 %1</translation>
        </message>
        <message>
            <source>Its run, time</source>
            <translation>航次，时间</translation>
        </message>
        <message>
            <source>Its height</source>
            <translation>其高程</translation>
        </message>
        <message>
            <source>What is known of the picked point</source>
            <translation>所选点的信息</translation>
        </message>
        <message>
            <source>Close</source>
            <translation>关闭</translation>
        </message>
        <message>
            <source>Select this stretch</source>
            <translation>选择此段</translation>
        </message>
        <message>
            <source>Selects the track five seconds before and after the nearest sample, in all views.</source>
            <translation>在所有视图中选择最近样点前后五秒的轨迹。</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::ReportView</name>
        <message>
            <source>Report</source>
            <translation>报告</translation>
        </message>
        <message>
            <source>Save as PDF…</source>
            <translation>另存为 PDF…</translation>
        </message>
        <message>
            <source>Print…</source>
            <translation>打印…</translation>
        </message>
        <message>
            <source>The report cannot be drawn.</source>
            <translation>报告无法显示。</translation>
        </message>
        <message>
            <source>The report is being made ready…</source>
            <translation>正在准备报告…</translation>
        </message>
        <message>
            <source>No report yet. Process the survey: what it says to its client will stand here.</source>
            <translation>尚无报告。处理测量后，给客户的报告将显示在这里。</translation>
        </message>
        <message>
            <source>%1: cannot be written (%2)</source>
            <translation>%1：无法写入（%2）</translation>
        </message>
        <message>
            <source>Save the report</source>
            <translation>保存报告</translation>
        </message>
        <message>
            <source>PDF (*.pdf)</source>
            <translation>PDF (*.pdf)</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::SettingEditor</name>
        <message>
            <source>&lt;p&gt;%1&lt;/p&gt;&lt;p&gt;Permitted: %2&lt;br&gt;Default: %3&lt;br&gt;&lt;tt&gt;%4&lt;/tt&gt;&lt;/p&gt;</source>
            <translation>&lt;p&gt;%1&lt;/p&gt;&lt;p&gt;允许值：%2&lt;br&gt;默认：%3&lt;br&gt;&lt;tt&gt;%4&lt;/tt&gt;&lt;/p&gt;</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::ShortcutsDialog</name>
        <message>
            <source>Keys</source>
            <translation>快捷键</translation>
        </message>
        <message>
            <source>Arrows</source>
            <translation>方向键</translation>
        </message>
        <message>
            <source>Move the map</source>
            <translation>移动地图</translation>
        </message>
        <message>
            <source>Zoom in and out</source>
            <translation>放大和缩小</translation>
        </message>
        <message>
            <source>Show all</source>
            <translation>显示全部</translation>
        </message>
        <message>
            <source>End a line</source>
            <translation>结束画线</translation>
        </message>
        <message>
            <source>Take the last vertex back</source>
            <translation>撤回最后一点</translation>
        </message>
        <message>
            <source>Leave the tool, select nothing</source>
            <translation>退出工具，取消选择</translation>
        </message>
        <message>
            <source>Window</source>
            <translation>窗口</translation>
        </message>
        <message>
            <source>Tools</source>
            <translation>工具</translation>
        </message>
        <message>
            <source>On the map</source>
            <translation>地图上</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::StartPage</name>
        <message>
            <source>Quick plot: a small one, done in a second</source>
            <translation>快速地块：小样例，一秒完成</translation>
        </message>
        <message>
            <source>Mango orchard: terraces, plants, poor GNSS</source>
            <translation>芒果园：梯田、植被、GNSS 差</translation>
        </message>
        <message>
            <source>From a walk to a terrain model that you can sign for.</source>
            <translation>走一圈，得到可以签字的地形模型。</translation>
        </message>
        <message>
            <source>Open a survey…</source>
            <translation>打开测量…</translation>
        </message>
        <message>
            <source>A survey.json, or a folder that holds one. Or drop it onto this window.</source>
            <translation>survey.json 或其所在文件夹，也可拖放到此窗口。</translation>
        </message>
        <message>
            <source>or drop a survey.json, or its folder, onto this window</source>
            <translation>或将 survey.json 或其文件夹拖放到此窗口</translation>
        </message>
        <message>
            <source>Samples: one click to a finished DEM</source>
            <translation>样例：单击即得 DEM</translation>
        </message>
        <message>
            <source>Recent surveys</source>
            <translation>最近的测量</translation>
        </message>
        <message>
            <source>None yet: the surveys that you open will stand here.</source>
            <translation>暂无：打开过的测量将显示在这里。</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::StepCard</name>
        <message numerus="yes">
            <source>%n more setting(s)</source>
            <translation>
                <numerusform>其余 %n 项设置</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::StepsPanel</name>
        <message>
            <source>Open a survey…</source>
            <translation>打开测量…</translation>
        </message>
        <message>
            <source>A survey.json, or the folder that holds one</source>
            <translation>survey.json 或其所在文件夹</translation>
        </message>
        <message>
            <source>Tune on the marks</source>
            <translation>用标志点调参</translation>
        </message>
        <message>
            <source>Searches noise parameters of the method that make errors at control marks small, and takes them only where they hold out better on marks left out</source>
            <translation>搜索使控制点误差变小的噪声参数，仅当在留出的标志点上更好时才采用</translation>
        </message>
        <message>
            <source>Export…</source>
            <translation>导出…</translation>
        </message>
        <message>
            <source>Writes DEM, mesh, tracks and report into a folder</source>
            <translation>将 DEM、网格、轨迹和报告写入文件夹</translation>
        </message>
        <message>
            <source>Copy as command</source>
            <translation>复制为命令</translation>
        </message>
        <message>
            <source>The terrawalk command line that makes the same files</source>
            <translation>生成相同文件的 terrawalk 命令</translation>
        </message>
        <message>
            <source>Earlier runs</source>
            <translation>以前的处理</translation>
        </message>
        <message>
            <source>Earlier runs: choosing one shows its results and takes its settings</source>
            <translation>以前的处理：选择后显示其结果并采用其设置</translation>
        </message>
        <message>
            <source>Show the accuracy</source>
            <translation>查看精度</translation>
        </message>
        <message>
            <source>Errors at marks, group by group</source>
            <translation>各组标志点误差</translation>
        </message>
        <message>
            <source>Process</source>
            <translation>处理</translation>
        </message>
        <message>
            <source>Fuse, clean, make the surface and check it (F5)</source>
            <translation>融合、清理、生成曲面并检核 (F5)</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation>取消</translation>
        </message>
        <message>
            <source>%1 · %2 left</source>
            <translation>%1 · 剩余%2</translation>
        </message>
        <message>
            <source>%1 · %2</source>
            <translation>%1 · %2</translation>
        </message>
        <message numerus="yes">
            <source>%n run(s)</source>
            <translation>
                <numerusform>%n 个航次</numerusform>
            </translation>
        </message>
        <message>
            <source>nothing open</source>
            <translation>未打开</translation>
        </message>
        <message>
            <source>tuned</source>
            <translation>已调参</translation>
        </message>
        <message>
            <source>defaults</source>
            <translation>默认</translation>
        </message>
        <message>
            <source>changed</source>
            <translation>已更改</translation>
        </message>
        <message>
            <source>done</source>
            <translation>完成</translation>
        </message>
        <message>
            <source>not checked yet</source>
            <translation>尚未检核</translation>
        </message>
        <message>
            <source>Process the survey to see its errors at the marks.</source>
            <translation>处理测量后可查看标志点误差。</translation>
        </message>
        <message>
            <source>Process again</source>
            <translation>重新处理</translation>
        </message>
        <message>
            <source>about 1 s</source>
            <translation>约 1 秒</translation>
        </message>
        <message>
            <source>about %1 s</source>
            <translation>约 %1 秒</translation>
        </message>
        <message>
            <source>about %1 min</source>
            <translation>约 %1 分钟</translation>
        </message>
        <message>
            <source>about %1 h</source>
            <translation>约 %1 小时</translation>
        </message>
        <message>
            <source>Stop what is running; nothing is lost (Ctrl+.)</source>
            <translation>停止当前任务，不会丢失任何内容 (Ctrl+.)</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::SurveySession</name>
        <message>
            <source>Cancelled; what was there before is still there.</source>
            <translation>已取消，原有内容保持不变。</translation>
        </message>
        <message>
            <source>Opened %1.</source>
            <translation>已打开 %1。</translation>
        </message>
        <message>
            <source> %1: %2.</source>
            <translation> %1：%2。</translation>
        </message>
        <message>
            <source>Processed.</source>
            <translation>处理完成。</translation>
        </message>
        <message>
            <source>tune</source>
            <translation>调参</translation>
        </message>
        <message>
            <source>Exported to %1.</source>
            <translation>已导出到 %1。</translation>
        </message>
        <message>
            <source>%1 = %2</source>
            <translation>%1 = %2</translation>
        </message>
        <message>
            <source>load settings</source>
            <translation>载入设置</translation>
        </message>
        <message>
            <source>Settings read from %1.</source>
            <translation>已从 %1 读取设置。</translation>
        </message>
        <message>
            <source>Saved to %1.</source>
            <translation>已保存到 %1。</translation>
        </message>
        <message>
            <source>The saved settings cannot be read: the defaults stand instead.</source>
            <translation>已保存的设置无法读取：使用默认值。</translation>
        </message>
        <message>
            <source>Changes cannot be kept against a crash: %1</source>
            <translation>无法为防崩溃而保存更改：%1</translation>
        </message>
        <message>
            <source>unsaved changes</source>
            <translation>未保存的更改</translation>
        </message>
        <message>
            <source>Unsaved changes of the last time are back; undo takes them away.</source>
            <translation>上次未保存的更改已恢复，可用撤销去除。</translation>
        </message>
        <message>
            <source>go back to an earlier run</source>
            <translation>回到以前的处理</translation>
        </message>
        <message>
            <source>%1: cannot be written (%2); check that you may write there</source>
            <translation>%1：无法写入（%2），请检查写入权限</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::SurveyTreeModel</name>
        <message>
            <source>any reading</source>
            <translation>全部读数</translation>
        </message>
        <message>
            <source>GNSS</source>
            <translation>GNSS</translation>
        </message>
        <message>
            <source>barometer</source>
            <translation>气压计</translation>
        </message>
        <message>
            <source>optical flow</source>
            <translation>光流</translation>
        </message>
        <message>
            <source>attitude</source>
            <translation>姿态</translation>
        </message>
        <message>
            <source>range</source>
            <translation>测距</translation>
        </message>
        <message>
            <source>Survey</source>
            <translation>测量</translation>
        </message>
        <message>
            <source>Runs</source>
            <translation>航次</translation>
        </message>
        <message>
            <source>left out</source>
            <translation>已排除</translation>
        </message>
        <message>
            <source>empty</source>
            <translation>空</translation>
        </message>
        <message>
            <source>Area run %1</source>
            <translation>面积航次 %1</translation>
        </message>
        <message>
            <source>Fixed-point run %1</source>
            <translation>定点航次 %1</translation>
        </message>
        <message>
            <source>, starts on %1</source>
            <translation>，起于 %1</translation>
        </message>
        <message>
            <source>, ends on %1</source>
            <translation>，止于 %1</translation>
        </message>
        <message>
            <source>; %1 records</source>
            <translation>；%1 条记录</translation>
        </message>
        <message>
            <source>%1 m, %2</source>
            <translation>%1 m，%2</translation>
        </message>
        <message>
            <source>; %1 ground points used</source>
            <translation>；使用 %1 个地面点</translation>
        </message>
        <message>
            <source>Marks</source>
            <translation>标志点</translation>
        </message>
        <message>
            <source>Control mark: may hold the track</source>
            <translation>控制点：可约束轨迹</translation>
        </message>
        <message>
            <source>Check mark: only ever measures errors</source>
            <translation>检核点：仅用于衡量误差</translation>
        </message>
        <message>
            <source>control</source>
            <translation>控制</translation>
        </message>
        <message>
            <source>check</source>
            <translation>检核</translation>
        </message>
        <message>
            <source>; surface less mark %1</source>
            <translation>；曲面减标志点 %1</translation>
        </message>
        <message>
            <source>Edits</source>
            <translation>编辑</translation>
        </message>
        <message>
            <source>%1 without %2</source>
            <translation>%1 不含%2</translation>
        </message>
        <message>
            <source>Breakline</source>
            <translation>断裂线</translation>
        </message>
        <message>
            <source>Soft breakline</source>
            <translation>软断裂线</translation>
        </message>
        <message>
            <source>Boundary</source>
            <translation>边界</translation>
        </message>
        <message>
            <source>Hole</source>
            <translation>空洞</translation>
        </message>
        <message numerus="yes">
            <source>%n point(s)</source>
            <translation>
                <numerusform>%n 个点</numerusform>
            </translation>
        </message>
        <message>
            <source>Results</source>
            <translation>结果</translation>
        </message>
        <message>
            <source>DEM</source>
            <translation>DEM</translation>
        </message>
        <message>
            <source>Uncertainty</source>
            <translation>不确定度</translation>
        </message>
        <message>
            <source>median %1 m</source>
            <translation>中位数 %1 m</translation>
        </message>
        <message>
            <source>Mesh</source>
            <translation>网格</translation>
        </message>
        <message>
            <source>%1 triangles</source>
            <translation>%1 个三角形</translation>
        </message>
        <message>
            <source>Terrace edges</source>
            <translation>梯田边缘</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::TerrainView</name>
        <message>
            <source>3-D view</source>
            <translation>三维视图</translation>
        </message>
        <message>
            <source>3-D view tools</source>
            <translation>三维视图工具</translation>
        </message>
        <message>
            <source>Oblique</source>
            <translation>斜视</translation>
        </message>
        <message>
            <source>From the south-west, half above</source>
            <translation>从西南斜上方</translation>
        </message>
        <message>
            <source>Above</source>
            <translation>俯视</translation>
        </message>
        <message>
            <source>From above, north up</source>
            <translation>从上方，北向上</translation>
        </message>
        <message>
            <source>N</source>
            <translation>北</translation>
        </message>
        <message>
            <source>From the north</source>
            <translation>从北</translation>
        </message>
        <message>
            <source>E</source>
            <translation>东</translation>
        </message>
        <message>
            <source>From the east</source>
            <translation>从东</translation>
        </message>
        <message>
            <source>S</source>
            <translation>南</translation>
        </message>
        <message>
            <source>From the south</source>
            <translation>从南</translation>
        </message>
        <message>
            <source>W</source>
            <translation>西</translation>
        </message>
        <message>
            <source>From the west</source>
            <translation>从西</translation>
        </message>
        <message>
            <source>Exaggeration of heights</source>
            <translation>高程夸大</translation>
        </message>
        <message>
            <source>Heights are drawn this many times as high as they are.</source>
            <translation>高程按此倍数放大绘制。</translation>
        </message>
        <message>
            <source>Heights × </source>
            <translation>高程 × </translation>
        </message>
        <message>
            <source>Light</source>
            <translation>光照</translation>
        </message>
        <message>
            <source>Direction of the light</source>
            <translation>光照方向</translation>
        </message>
        <message>
            <source>From where the light comes: north, east, south, west, north</source>
            <translation>光照来向：北、东、南、西、北</translation>
        </message>
        <message>
            <source>Show</source>
            <translation>显示</translation>
        </message>
        <message>
            <source>What is drawn on the surface</source>
            <translation>曲面上绘制的内容</translation>
        </message>
        <message>
            <source>Tracks, laid on the surface</source>
            <translation>贴在曲面上的轨迹</translation>
        </message>
        <message>
            <source>Ground points</source>
            <translation>地面点</translation>
        </message>
        <message>
            <source>Marks</source>
            <translation>标志点</translation>
        </message>
        <message>
            <source>Contours</source>
            <translation>等高线</translation>
        </message>
        <message>
            <source>Reset</source>
            <translation>复位</translation>
        </message>
        <message>
            <source>The first view again (Home)</source>
            <translation>恢复初始视图 (Home)</translation>
        </message>
        <message>
            <source>Picture of the surface</source>
            <translation>曲面图像</translation>
        </message>
        <message>
            <source>The surface is being made ready…</source>
            <translation>正在准备曲面…</translation>
        </message>
        <message>
            <source>Open a survey to see it here.</source>
            <translation>打开测量后在此查看。</translation>
        </message>
        <message>
            <source>No surface yet. Process the survey to see it here.</source>
            <translation>尚无曲面。处理测量后在此查看。</translation>
        </message>
    </context>
</TS>
