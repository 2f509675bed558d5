<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
    <context>
        <name>AccuracyWords</name>
        <message>
            <source>Before: %1 m.</source>
            <translation>之前：%1 m。</translation>
        </message>
    </context>
    <context>
        <name>FixClass</name>
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
    </context>
    <context>
        <name>Language</name>
        <message>
            <source>%1 %2</source>
            <translation>%1%2</translation>
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
        <message>
            <source>Change of height</source>
            <translation>高程变化</translation>
        </message>
        <message>
            <source>Track, residual</source>
            <translation>轨迹，残差</translation>
        </message>
        <message>
            <source>Ground points</source>
            <translation>地面点</translation>
        </message>
    </context>
    <context>
        <name>MapScene</name>
        <message>
            <source>not told</source>
            <translation>未知</translation>
        </message>
        <message>
            <source>used</source>
            <translation>已用</translation>
        </message>
        <message>
            <source>thinned, left out</source>
            <translation>抽稀、排除</translation>
        </message>
        <message>
            <source>refused</source>
            <translation>剔除</translation>
        </message>
    </context>
    <context>
        <name>PlotData</name>
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
            <translation>测线 %1 的记录中没有该传感器的读数。</translation>
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
            <translation>该测线没有地面点：测距仪无输出。</translation>
        </message>
        <message>
            <source>Mark</source>
            <translation>标志点</translation>
        </message>
        <message>
            <source>Track</source>
            <translation>轨迹</translation>
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
            <translation>融合测线</translation>
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
            <translation>%1，测线 %2</translation>
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
        <message>
            <source>No search is known. Tune the survey on its marks, or open a file that terrawalk tune wrote.</source>
            <translation>还没有搜索记录。请用标志点调参，或打开 terrawalk tune 写出的文件。</translation>
        </message>
        <message>
            <source>Evaluations of the loss</source>
            <translation>损失函数计算次数</translation>
        </message>
        <message>
            <source>%1, seed %2</source>
            <translation>%1，种子 %2</translation>
        </message>
        <message>
            <source>The least loss found so far; it counts every evaluation.</source>
            <translation>迄今最小的损失；每次计算都计入。</translation>
        </message>
        <message>
            <source>Nothing to compare yet. Tune with several optimisers or seeds, or open the CSV of an experiment such as terrawalk experiment fig10.</source>
            <translation>还没有可比较的内容。请用多个优化器或种子调参，或打开实验的 CSV，例如 terrawalk experiment fig10。</translation>
        </message>
        <message>
            <source>Optimiser</source>
            <translation>优化器</translation>
        </message>
        <message>
            <source>Up to %1 searches each. Box: quartiles and median; whiskers: 1.5 box lengths at most.</source>
            <translation>每个至多 %1 次搜索。箱：四分位数和中位数；须：至多 1.5 倍箱长。</translation>
        </message>
        <message>
            <source>Convergence</source>
            <translation>收敛过程</translation>
        </message>
        <message>
            <source>Optimisers compared</source>
            <translation>优化器比较</translation>
        </message>
        <message>
            <source>%1 readings lie above the picture, up to %2.</source>
            <translation>%1 个读数超出图面，最大 %2。</translation>
        </message>
        <message>
            <source>GNSS fix</source>
            <translation>GNSS 定位状态</translation>
        </message>
        <message>
            <source>other</source>
            <translation>其他</translation>
        </message>
        <message>
            <source>Track, tied</source>
            <translation>轨迹，受约束</translation>
        </message>
        <message>
            <source>Surface, tied</source>
            <translation>曲面，受约束</translation>
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
        <message>
            <source>less %1</source>
            <translation>减去 %1</translation>
        </message>
        <message>
            <source>pale: within 1.96 σ</source>
            <translation>淡色：在 1.96 σ 以内</translation>
        </message>
        <message>
            <source>σ of the survey alone</source>
            <translation>仅本次测量的 σ</translation>
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
            <translation>测线排除</translation>
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
        <message>
            <source>reading</source>
            <translation>读取</translation>
        </message>
        <message>
            <source>writing</source>
            <translation>写出</translation>
        </message>
        <message>
            <source>comparing</source>
            <translation>比较</translation>
        </message>
        <message>
            <source>done</source>
            <translation>完成</translation>
        </message>
        <message>
            <source>adjusting all runs</source>
            <translation>整体平差</translation>
        </message>
        <message>
            <source>making the surface</source>
            <translation>生成曲面</translation>
        </message>
        <message>
            <source>processed</source>
            <translation>处理完毕</translation>
        </message>
        <message>
            <source>tuned</source>
            <translation>调参完毕</translation>
        </message>
        <message>
            <source>searching</source>
            <translation>搜索</translation>
        </message>
        <message>
            <source>triangulating</source>
            <translation>三角剖分</translation>
        </message>
        <message>
            <source>gridding</source>
            <translation>格网化</translation>
        </message>
        <message>
            <source>contours</source>
            <translation>等高线</translation>
        </message>
        <message>
            <source>joining contours</source>
            <translation>连接等高线</translation>
        </message>
        <message>
            <source>smoothing</source>
            <translation>平滑</translation>
        </message>
        <message>
            <source>looking for statistical outliers</source>
            <translation>查找统计粗差</translation>
        </message>
        <message>
            <source>looking for isolated points</source>
            <translation>查找孤立点</translation>
        </message>
        <message>
            <source>looking for what stands above the ground</source>
            <translation>查找地面以上物</translation>
        </message>
        <message>
            <source>points cleaned</source>
            <translation>点已清理</translation>
        </message>
        <message>
            <source>variance of the method: noise times %1, structure times %2, learnt from %3 points left out</source>
            <translation>方法自身的方差：噪声乘以 %1，结构乘以 %2，由 %3 个留出点学得</translation>
        </message>
        <message>
            <source>terrace edges found but not kept to: %1; method %2, which cannot follow them, foretells points left out better than those that do</source>
            <translation>找到但未采用的梯田边缘：%1 条；方法 %2 不能沿边缘构面，但对留出点的预测优于能沿边缘构面的方法</translation>
        </message>
        <message>
            <source>terrace edges are not looked for: method %1 cannot follow them</source>
            <translation>不查找梯田边缘：方法 %1 不能沿边缘构面</translation>
        </message>
        <message>
            <source>terrace edges are not looked for among more than %1 points</source>
            <translation>点数超过 %1 时不查找梯田边缘</translation>
        </message>
        <message>
            <source>placing rays</source>
            <translation>放置激光射线</translation>
        </message>
        <message>
            <source>following laser rays</source>
            <translation>追踪激光射线</translation>
        </message>
        <message>
            <source>obstacles</source>
            <translation>查找障碍物</translation>
        </message>
        <message>
            <source>free height</source>
            <translation>计算空闲高度</translation>
        </message>
        <message>
            <source>no ground point has a sound ray</source>
            <translation>没有地面点带有可靠的激光射线</translation>
        </message>
        <message>
            <source>the ground layer must lie below the greatest height</source>
            <translation>地面层必须低于最大高度</translation>
        </message>
        <message>
            <source>Space above the ground</source>
            <translation>地面以上空间</translation>
        </message>
        <message>
            <source>Rays</source>
            <translation>射线</translation>
        </message>
        <message>
            <source>Space</source>
            <translation>空间</translation>
        </message>
        <message>
            <source>Free</source>
            <translation>空闲</translation>
        </message>
        <message>
            <source>Obstacles</source>
            <translation>障碍物</translation>
        </message>
        <message>
            <source>%1; %2 ground points left out, %3 of them below the ground</source>
            <translation>%1 条；舍去 %2 个地面点，其中 %3 个低于地面</translation>
        </message>
        <message>
            <source>%1 m3 free, %2 m3 occupied, in voxels of %3 m about %4 %5 %6</source>
            <translation>空闲 %1 m3，占用 %2 m3，体素 %3 m，原点 %4 %5 %6</translation>
        </message>
        <message>
            <source>right above the ground in %1 of %2 cells (%3 %), there to %4 m (median)</source>
            <translation>%2 个格网中有 %1 个（%3 %）紧贴地面处空闲，其中位高度 %4 m</translation>
        </message>
        <message>
            <source>above the ground in %1 cells (%2 %)</source>
            <translation>地面以上有障碍物的格网 %1 个（%2 %）</translation>
        </message>
        <message>
            <source>not determined with %1 marks</source>
            <translation>%1 个标志点不足以确定</translation>
        </message>
        <message>
            <source>not determined with %1 mark</source>
            <translation>%1 个标志点不足以确定</translation>
        </message>
        <message>
            <source>looking for terrace edges</source>
            <translation>查找梯田边缘</translation>
        </message>
        <message>
            <source>hashing the inputs</source>
            <translation>计算输入文件校验和</translation>
        </message>
        <message>
            <source>fitting the variogram</source>
            <translation>拟合变异函数</translation>
        </message>
        <message>
            <source>fitting the B-spline</source>
            <translation>拟合 B 样条</translation>
        </message>
        <message>
            <source>reading breaklines</source>
            <translation>读取断裂线</translation>
        </message>
        <message>
            <source>the surface</source>
            <translation>曲面</translation>
        </message>
        <message>
            <source>the ground points</source>
            <translation>地面点</translation>
        </message>
        <message>
            <source>the ground below the array</source>
            <translation>阵列下方地面</translation>
        </message>
        <message>
            <source>none</source>
            <translation>无</translation>
        </message>
        <message>
            <source>no mark was measured</source>
            <translation>没有测过标志点</translation>
        </message>
        <message>
            <source>no check mark was compared</source>
            <translation>没有检核点参与比较</translation>
        </message>
        <message>
            <source>none was measured</source>
            <translation>没有测过</translation>
        </message>
        <message>
            <source>no surface was made</source>
            <translation>没有生成曲面</translation>
        </message>
        <message>
            <source>an unknown area</source>
            <translation>面积未知</translation>
        </message>
        <message>
            <source>too high</source>
            <translation>偏高</translation>
        </message>
        <message>
            <source>too low</source>
            <translation>偏低</translation>
        </message>
        <message>
            <source>No accuracy can be stated: the survey has no marks to compare with.</source>
            <translation>无法说明精度：本次测量没有可比较的标志点。</translation>
        </message>
        <message>
            <source>No accuracy can be stated: no check mark could be compared with the product.</source>
            <translation>无法说明精度：没有检核点能与成果比较。</translation>
        </message>
        <message>
            <source>The survey has no marks measured by total station. Nothing independent says how far the terrain model is from the ground.</source>
            <translation>本次测量没有全站仪测定的标志点。没有独立数据说明地形模型与地面相差多少。</translation>
        </message>
        <message>
            <source>No check mark could be compared with the product.</source>
            <translation>没有检核点能与成果比较。</translation>
        </message>
        <message>
            <source>Whether the check marks stand among plants or in the open is not known: the points were not looked through for what stands on the ground, or too few lie near the marks.</source>
            <translation>不知道检核点在植被中还是开阔地上：没有检核点云中的地面以上物，或附近的点太少。</translation>
        </message>
        <message>
            <source>no GNSS: raw positions are the start and the velocity summed up from there</source>
            <translation>没有 GNSS：原始位置由起点和速度累加而得</translation>
        </message>
        <message>
            <source>no known mark to zero the barometer on: it is tied to the median GNSS height of the run</source>
            <translation>没有可供气压计归零的标志点：取该条测线 GNSS 高程的中位数</translation>
        </message>
        <message>
            <source>no barometer in use: GNSS height is used whatever the fix</source>
            <translation>未使用气压计：不论定位状态都使用 GNSS 高程</translation>
        </message>
        <message>
            <source>GNSS height of any fix stands in there</source>
            <translation>此处用任意解的 GNSS 高程代替</translation>
        </message>
        <message>
            <source>nothing measures height there, the walk is taken to climb little</source>
            <translation>此处没有高程观测，假定测线起伏很小</translation>
        </message>
        <message>
            <source>nothing in the log measures height: it is held near that of the start</source>
            <translation>记录中没有高程观测：保持在起点高程附近</translation>
        </message>
        <message>
            <source>the adjustment of all runs has no solution: the tracks are those of the filter, crossovers are not used</source>
            <translation>整体平差无解：轨迹取自滤波器，不使用交叉点</translation>
        </message>
        <message>
            <source>it walks straight, but no mark lies near its end</source>
            <translation>直线行走，但终点附近没有标志点</translation>
        </message>
        <message>
            <source>it has no positions</source>
            <translation>没有位置</translation>
        </message>
        <message>
            <source>as told</source>
            <translation>按指定</translation>
        </message>
        <message>
            <source>no log has positions: say where the zero point is</source>
            <translation>没有记录含位置：请填写零点</translation>
        </message>
        <message>
            <source>it is a second table of marks</source>
            <translation>这是第二个标志点表</translation>
        </message>
        <message>
            <source>it is a trajectory, no log of the array</source>
            <translation>这是轨迹，不是阵列记录</translation>
        </message>
        <message>
            <source>it is neither a log of the array nor a table of marks</source>
            <translation>既不是阵列记录，也不是标志点表</translation>
        </message>
        <message>
            <source>testing on parts left out</source>
            <translation>在留出部分上检验</translation>
        </message>
        <message>
            <source>tuning</source>
            <translation>调参</translation>
        </message>
        <message>
            <source>The search found nothing better than the values that it started from; these stay.</source>
            <translation>搜索没有找到比初始值更好的值；保留初始值。</translation>
        </message>
        <message>
            <source>There is one part only, so nothing can be left out to test the tuned values on: the default is not replaced by them.</source>
            <translation>只有一个部分，无法留出数据检验调参结果：不替换默认值。</translation>
        </message>
        <message>
            <source>%1, best loss %2</source>
            <translation>%1，最小损失 %2</translation>
        </message>
        <message>
            <source>looking at the effect of %1</source>
            <translation>考察 %1 的影响</translation>
        </message>
        <message>
            <source>The tuned values hold out better than those before: %1.</source>
            <translation>调参结果在留出数据上优于原值：%1。</translation>
        </message>
        <message>
            <source>The tuned values do not hold out better than those before: %1. `process --tune` does not adopt them.</source>
            <translation>调参结果在留出数据上不优于原值：%1。`process --tune` 不采用。</translation>
        </message>
        <message>
            <source>on parts left out of the tuning the loss goes from %1 to %2, a gain of %3 with a standard error of %4</source>
            <translation>在未参与调参的部分上损失由 %1 变为 %2，改进 %3，标准差 %4</translation>
        </message>
        <message>
            <source>reading %1</source>
            <translation>读取 %1</translation>
        </message>
        <message>
            <source>writing %1</source>
            <translation>写出 %1</translation>
        </message>
        <message>
            <source>fusing %1</source>
            <translation>融合 %1</translation>
        </message>
        <message>
            <source>smoothing %1</source>
            <translation>平滑 %1</translation>
        </message>
        <message>
            <source>fused %1</source>
            <translation>已融合 %1</translation>
        </message>
        <message>
            <source>Height error of %1 (RMSE)</source>
            <translation>%1的高程误差（RMSE）</translation>
        </message>
        <message>
            <source>at %1</source>
            <translation>在 %1处</translation>
        </message>
        <message>
            <source>%1 check marks</source>
            <translation>%1 个检核点</translation>
        </message>
        <message>
            <source>%1 check mark</source>
            <translation>%1 个检核点</translation>
        </message>
        <message>
            <source>%1 control marks</source>
            <translation>%1 个控制点</translation>
        </message>
        <message>
            <source>%1 control mark</source>
            <translation>%1 个控制点</translation>
        </message>
        <message>
            <source>%1 marks</source>
            <translation>%1 个标志点</translation>
        </message>
        <message>
            <source>%1 mark</source>
            <translation>%1 个标志点</translation>
        </message>
        <message>
            <source>%1 comparisons</source>
            <translation>%1 次比较</translation>
        </message>
        <message>
            <source>%1 comparison</source>
            <translation>%1 次比较</translation>
        </message>
        <message>
            <source>at %1; %2 before fusion and %3 now at the %4 that both reach</source>
            <translation>在 %1处；两者都到达的 %4 个点上，融合前 %2，现在 %3</translation>
        </message>
        <message>
            <source>at %1; %2 before fusion</source>
            <translation>在 %1 处；融合前 %2</translation>
        </message>
        <message>
            <source>at %1; sensors as they are</source>
            <translation>在 %1 处；传感器原始数据</translation>
        </message>
        <message>
            <source>of %1 measured</source>
            <translation>共测 %1 个</translation>
        </message>
        <message>
            <source>of %1 measured; %2 beside them</source>
            <translation>共测 %1 个；另有 %2</translation>
        </message>
        <message>
            <source>none was measured; %1 beside them</source>
            <translation>没有测过；另有 %1</translation>
        </message>
        <message>
            <source>%1 m cells</source>
            <translation>%1 m 格网</translation>
        </message>
        <message>
            <source>%1 triangulated; %2 ground points</source>
            <translation>三角剖分 %1；%2 个地面点</translation>
        </message>
        <message>
            <source>Heights of %1 differ from %2 by %3 (vertical RMSE; 95 % interval %4 to %5). With the marks' own error of %6 it is %7.</source>
            <translation>%1的高程与 %2 相差 %3（高程 RMSE；95 % 区间 %4 至 %5）。计入标志点自身误差 %6 后为 %7。</translation>
        </message>
        <message>
            <source>Heights of %1 differ from %2 by %3 (vertical RMSE; 95 % interval %4 to %5).</source>
            <translation>%1的高程与 %2 相差 %3（高程 RMSE；95 % 区间 %4 至 %5）。</translation>
        </message>
        <message>
            <source>Heights of %1 differ from %2 by %3 (vertical RMSE). With the marks' own error of %4 it is %5.</source>
            <translation>%1的高程与 %2 相差 %3（高程 RMSE）。计入标志点自身误差 %4 后为 %5。</translation>
        </message>
        <message>
            <source>Heights of %1 differ from %2 by %3 (vertical RMSE).</source>
            <translation>%1的高程与 %2 相差 %3（高程 RMSE）。</translation>
        </message>
        <message>
            <source>Tested with %1 check marks, at least the %2 that the ASPRS Positional Accuracy Standards, Edition 2, ask for. No accuracy class is claimed: that takes a class to test against and check marks on open ground.</source>
            <translation>用 %1 个检核点检验，不少于 ASPRS 位置精度标准第 2 版要求的 %2 个。不声明精度等级：那需要给定等级和开阔地上的检核点。</translation>
        </message>
        <message>
            <source>Tested using the reduced number of %1. The ASPRS Positional Accuracy Standards, Edition 2, ask for %2; with fewer, no accuracy class can be claimed.</source>
            <translation>仅用 %1 检验。ASPRS 位置精度标准第 2 版要求 %2 个；少于此数不能声明精度等级。</translation>
        </message>
        <message>
            <source>Tested %1 vertical accuracy at 95 % confidence level (NSSDA, FGDC-STD-007.3-1998: 1.9600 times the RMSE of %2).</source>
            <translation>经检验，95 % 置信水平下高程精度 %1（NSSDA，FGDC-STD-007.3-1998：%2 的 RMSE 的 1.9600 倍）。</translation>
        </message>
        <message>
            <source>By the formula of the NSSDA (FGDC-STD-007.3-1998) it would be %1 vertical accuracy at 95 % confidence level (1.9600 times the RMSE of %2), but the NSSDA asks for %3 and more.</source>
            <translation>按 NSSDA（FGDC-STD-007.3-1998）公式，95 % 置信水平下高程精度为 %1（%2 的 RMSE 的 1.9600 倍），但 NSSDA 要求 %3 个以上。</translation>
        </message>
        <message>
            <source>Errors in plan turn into errors of height on slopes: the %1 along an axis seen at the stands, times the slope at %2, is %3 (RMSE), %4 % of the mean square height error.</source>
            <translation>平面误差在斜坡上变成高程误差：静站处沿一轴的 %1 乘以 %2 处的坡度为 %3（RMSE），占高程均方误差的 %4 %。</translation>
        </message>
        <message>
            <source>Before fusion the height RMSE was %1 (%2); at the same %3 it is %4 now, %5 % less.</source>
            <translation>融合前高程 RMSE 为 %1（%2）；在同样的 %3 上现为 %4，减小 %5 %。</translation>
        </message>
        <message>
            <source>Before fusion the height RMSE was %1 (%2); at the same %3 it is %4 now, %5 % more.</source>
            <translation>融合前高程 RMSE 为 %1（%2）；在同样的 %3 上现为 %4，增大 %5 %。</translation>
        </message>
        <message>
            <source>Before fusion the height RMSE was %1 (%2); at the same %3 it is %4 now.</source>
            <translation>融合前高程 RMSE 为 %1（%2）；在同样的 %3 上现为 %4。</translation>
        </message>
        <message>
            <source>%1 of %2 heights (%3 %) lie within 1.96 predicted sigmas; 95 % would be right. The mean square of error over sigma is %4; 1 would be right.</source>
            <translation>%2 个高程中 %1 个（%3 %）在预测的 1.96 σ 以内；应为 95 %。误差与 σ 之比的均方为 %4；应为 1。</translation>
        </message>
        <message>
            <source>%1 of %2 heights (%3 %) lie within 1.96 predicted sigmas; 95 % would be right. The mean square of error over sigma is %4; 1 would be right, but so few decide little.</source>
            <translation>%2 个高程中 %1 个（%3 %）在预测的 1.96 σ 以内；应为 95 %。误差与 σ 之比的均方为 %4；应为 1，但数量太少，说明不了多少。</translation>
        </message>
        <message>
            <source>The heights lie %1 on average (%2): more than chance explains. Look for a wrong array height, a wrong start mark or a shifted datum.</source>
            <translation>高程平均%1（%2）：超出偶然误差。请检查阵列高度、起点标志或基准是否有误。</translation>
        </message>
        <message>
            <source>%1 is off by %2, more than %3 times the RMSE of the others: a possible blunder. It is counted.</source>
            <translation>%1 偏差 %2，超过其余点 RMSE 的 %3 倍：可能是粗差。已计入。</translation>
        </message>
        <message>
            <source>%1 lies outside the surface and could not be compared: %2.</source>
            <translation>%1 在曲面之外，无法比较：%2。</translation>
        </message>
        <message>
            <source>%1 lie outside the surface and could not be compared: %2.</source>
            <translation>%1 在曲面之外，无法比较：%2。</translation>
        </message>
        <message>
            <source>%1 has no ground point near enough and could not be compared: %2.</source>
            <translation>%1 附近没有地面点，无法比较：%2。</translation>
        </message>
        <message>
            <source>%1 have no ground point near enough and could not be compared: %2.</source>
            <translation>%1 附近没有地面点，无法比较：%2。</translation>
        </message>
        <message>
            <source>%1 was stood on without a sound range and could not be compared: %2.</source>
            <translation>%1 上静站时没有可靠测距，无法比较：%2。</translation>
        </message>
        <message>
            <source>%1 were stood on without a sound range and could not be compared: %2.</source>
            <translation>%1 上静站时没有可靠测距，无法比较：%2。</translation>
        </message>
        <message>
            <source>No check mark was compared. %1 stand in the report apart; errors at marks that may have served alignment or tuning do not certify the product.</source>
            <translation>没有检核点参与比较。%1 另列于报告中；可能用于对准或调参的标志点上的误差不能证明成果质量。</translation>
        </message>
        <message>
            <source>No check mark was compared, and none of the %1 tells an error that the estimator has not seen.</source>
            <translation>没有检核点参与比较，%1 中也没有估计器未见过的误差。</translation>
        </message>
        <message>
            <source>Standing on %1, the fused position was off by %2 in plan (RMSE). By the NSSDA that is %3 at 95 % confidence.</source>
            <translation>在 %1 上静站时，融合位置平面偏差 %2（RMSE）。按 NSSDA，95 % 置信为 %3。</translation>
        </message>
        <message>
            <source>Standing on %1, the fused position was off by %2 in plan (RMSE).</source>
            <translation>在 %1 上静站时，融合位置平面偏差 %2（RMSE）。</translation>
        </message>
        <message>
            <source>%1 is a small sample: the true error may differ a good deal from the figure found.</source>
            <translation>%1 样本太少：真实误差可能与所得数值相差很大。</translation>
        </message>
        <message>
            <source>%1 are a small sample: the true error may differ a good deal from the figure found.</source>
            <translation>%1 样本太少：真实误差可能与所得数值相差很大。</translation>
        </message>
        <message>
            <source>The estimator was tied to the mark or tuned on it in %1; these are listed and never counted.</source>
            <translation>%1 中估计器受该标志点约束或用其调参；这些只列出，从不计入。</translation>
        </message>
        <message>
            <source>Before fusion there is no surface to compare with: %1.</source>
            <translation>融合前没有可比较的曲面：%1。</translation>
        </message>
        <message>
            <source>The heights have no standard errors: %1.</source>
            <translation>高程没有标准差：%1。</translation>
        </message>
        <message>
            <source>The heights have no standard errors, and there is no multiband file: %1.</source>
            <translation>高程没有标准差，也没有多波段文件：%1。</translation>
        </message>
        <message>
            <source>Run %1 has no records for %2 s: the track there is a guess.</source>
            <translation>测线 %1 有 %2 s 没有记录：该处轨迹是推测的。</translation>
        </message>
        <message>
            <source>%1 (runs %2)</source>
            <translation>%1（测线 %2）</translation>
        </message>
        <message>
            <source>no epoch while the array stood on %1</source>
            <translation>阵列静站于 %1 时没有记录</translation>
        </message>
        <message>
            <source>no range while the array stood on %1: its height above the mark is taken to be %2 m</source>
            <translation>阵列静站于 %1 时没有测距：其高出标志点取为 %2 m</translation>
        </message>
        <message>
            <source>the barometer was silent on the marks: it is zeroed %1 s away from one</source>
            <translation>气压计在标志点上没有数据：在相距 %1 s 处归零</translation>
        </message>
        <message>
            <source>the barometer was silent for up to %1 s: %2</source>
            <translation>气压计中断最长 %1 s：%2</translation>
        </message>
        <message>
            <source>it walks straight and ends %1 m by GNSS from %2</source>
            <translation>直线行走，终点按 GNSS 距 %2 %1 m</translation>
        </message>
        <message>
            <source>its name says %1</source>
            <translation>文件名含 %1</translation>
        </message>
        <message>
            <source>it walks %1 m within %2 m</source>
            <translation>在 %2 m 范围内行走 %1 m</translation>
        </message>
        <message>
            <source>zero point: mean GNSS position of the ground where %1 of %2 walks start, %3 m apart at most; say where it is if you know it better</source>
            <translation>零点：%2 条测线中 %1 条起点处地面的 GNSS 平均位置，彼此相距至多 %3 m；如有更准确的坐标请填入</translation>
        </message>
        <message>
            <source>%1 is passed over: %2</source>
            <translation>略过 %1：%2</translation>
        </message>
        <message>
            <source>GNSS position</source>
            <translation>GNSS 位置</translation>
        </message>
        <message>
            <source>GNSS velocity</source>
            <translation>GNSS 速度</translation>
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
            <source>mean optical flow</source>
            <translation>平均光流</translation>
        </message>
        <message>
            <source>accelerometer</source>
            <translation>加速度计</translation>
        </message>
        <message>
            <source>height assumption</source>
            <translation>高度假设</translation>
        </message>
        <message>
            <source>leave-one-out</source>
            <translation>逐点留出</translation>
        </message>
        <message>
            <source>random-folds</source>
            <translation>随机分组</translation>
        </message>
        <message>
            <source>spatial-blocks</source>
            <translation>空间分块</translation>
        </message>
        <message>
            <source>heading row</source>
            <translation>航向方程</translation>
        </message>
        <message>
            <source>mark tie</source>
            <translation>标志点约束</translation>
        </message>
        <message>
            <source>GNSS height</source>
            <translation>GNSS 高程</translation>
        </message>
        <message>
            <source>no such file</source>
            <translation>没有这个文件</translation>
        </message>
        <message>
            <source>the file may not be read</source>
            <translation>没有读取该文件的权限</translation>
        </message>
        <message>
            <source>give this user the right to read it</source>
            <translation>请给当前用户读取权限</translation>
        </message>
        <message>
            <source>cannot write: this is a folder</source>
            <translation>无法写入：这是一个文件夹</translation>
        </message>
        <message>
            <source>cannot write: a folder of that name is in the way</source>
            <translation>无法写入：已有同名的文件夹</translation>
        </message>
        <message>
            <source>this is a folder</source>
            <translation>这是一个文件夹</translation>
        </message>
        <message>
            <source>name a file in it</source>
            <translation>请指定其中的一个文件</translation>
        </message>
        <message>
            <source>this is no regular file</source>
            <translation>这不是普通文件</translation>
        </message>
        <message>
            <source>copy the data to a file</source>
            <translation>请把数据复制到普通文件中</translation>
        </message>
        <message>
            <source>check that this is the right file</source>
            <translation>请确认文件是否正确</translation>
        </message>
        <message>
            <source>the file grows while it is read</source>
            <translation>读取时文件还在增长</translation>
        </message>
        <message>
            <source>try again</source>
            <translation>请再试一次</translation>
        </message>
        <message>
            <source>the text is UTF-16</source>
            <translation>文本编码是 UTF-16</translation>
        </message>
        <message>
            <source>save it as UTF-8</source>
            <translation>请另存为 UTF-8</translation>
        </message>
        <message>
            <source>NUL byte: this is no text, or the logger lost power while it wrote</source>
            <translation>有空字节：这不是文本，或者记录时断了电</translation>
        </message>
        <message>
            <source>end the file with the last whole line before it</source>
            <translation>请让文件止于它之前最后一个完整的行</translation>
        </message>
        <message>
            <source>the file is empty</source>
            <translation>文件是空的</translation>
        </message>
        <message>
            <source>the file cannot be opened</source>
            <translation>无法打开该文件</translation>
        </message>
        <message>
            <source>No space left on device</source>
            <translation>设备上没有剩余空间</translation>
        </message>
        <message>
            <source>Permission denied</source>
            <translation>没有权限</translation>
        </message>
        <message>
            <source>No such file or directory</source>
            <translation>没有这个文件或文件夹</translation>
        </message>
        <message>
            <source>Read-only file system</source>
            <translation>文件系统是只读的</translation>
        </message>
        <message>
            <source>Input/output error</source>
            <translation>读写出错</translation>
        </message>
        <message>
            <source>Is a directory</source>
            <translation>这是一个文件夹</translation>
        </message>
        <message>
            <source>Not a directory</source>
            <translation>这不是文件夹</translation>
        </message>
        <message>
            <source>File name too long</source>
            <translation>文件名太长</translation>
        </message>
        <message>
            <source>Too many open files</source>
            <translation>打开的文件太多</translation>
        </message>
        <message>
            <source>Disk quota exceeded</source>
            <translation>超出了磁盘配额</translation>
        </message>
        <message>
            <source>Device or resource busy</source>
            <translation>设备正忙</translation>
        </message>
        <message>
            <source>Success</source>
            <translation>成功</translation>
        </message>
        <message>
            <source>no header row</source>
            <translation>没有标题行</translation>
        </message>
        <message>
            <source>no header row before the data</source>
            <translation>数据之前没有标题行</translation>
        </message>
        <message>
            <source>the header row has no column time_s</source>
            <translation>标题行中没有 time_s 列</translation>
        </message>
        <message>
            <source>the first row after the # lines must name the columns, time_s among them</source>
            <translation># 行之后的第一行必须写列名，其中要有 time_s</translation>
        </message>
        <message>
            <source>no data rows after the header</source>
            <translation>标题行之后没有数据</translation>
        </message>
        <message>
            <source>the only row is cut off: it has no line end</source>
            <translation>唯一的一行不完整：没有换行符</translation>
        </message>
        <message>
            <source>end the last row with a line end if it is whole</source>
            <translation>如果最后一行是完整的，请补上换行符</translation>
        </message>
        <message>
            <source>check the logger's clock, and whether two logs were joined</source>
            <translation>请检查记录器的时钟，以及是否把两份日志拼在了一起</translation>
        </message>
        <message>
            <source>the line is no UTF-8 text</source>
            <translation>该行不是 UTF-8 文本</translation>
        </message>
        <message>
            <source>save the file as UTF-8 text</source>
            <translation>请把文件另存为 UTF-8 文本</translation>
        </message>
        <message>
            <source>keep one of the two lines</source>
            <translation>请只保留其中一行</translation>
        </message>
        <message>
            <source>write it like 2024-05-17T08:30:00Z</source>
            <translation>请写成 2024-05-17T08:30:00Z 的样子</translation>
        </message>
        <message>
            <source>give x y z in metres, parted by blanks</source>
            <translation>请以米为单位写 x y z，用空格分开</translation>
        </message>
        <message>
            <source>give metres</source>
            <translation>请用米为单位</translation>
        </message>
        <message>
            <source>a quotation mark is not closed</source>
            <translation>引号没有闭合</translation>
        </message>
        <message>
            <source>each column needs its own name</source>
            <translation>每一列都要有自己的列名</translation>
        </message>
        <message>
            <source>give a number with a decimal dot, or leave the field empty where the sensor gave no value</source>
            <translation>请用小数点写数；传感器没有给出数值时请留空</translation>
        </message>
        <message>
            <source>the decimal sign is a dot, and an empty field keeps its comma</source>
            <translation>小数点要用“.”，空字段也要保留逗号</translation>
        </message>
        <message>
            <source>the decimal sign is a dot, and fields are parted by commas</source>
            <translation>小数点要用“.”，字段之间用逗号分开</translation>
        </message>
        <message>
            <source>the last row has no line end; it is kept, since its last number is whole</source>
            <translation>最后一行没有换行符；因末尾的数完整，仍然保留</translation>
        </message>
        <message>
            <source>the time is missing</source>
            <translation>缺少时间</translation>
        </message>
        <message>
            <source>every row needs its time</source>
            <translation>每一行都要有时间</translation>
        </message>
        <message>
            <source>this is no time since the log's start</source>
            <translation>这不是从日志开始算起的时间</translation>
        </message>
        <message>
            <source>count time_s in seconds from the start of the log; start_utc ties it to UTC</source>
            <translation>time_s 要从日志开始以秒计；start_utc 把它与 UTC 联系起来</translation>
        </message>
        <message>
            <source>a latitude lies between -90 and 90 degrees</source>
            <translation>纬度在 -90 到 90 度之间</translation>
        </message>
        <message>
            <source>a longitude lies between -180 and 180 degrees</source>
            <translation>经度在 -180 到 180 度之间</translation>
        </message>
        <message>
            <source>a fix is a whole number from 0 to 9</source>
            <translation>定位状态是 0 到 9 的整数</translation>
        </message>
        <message>
            <source>a height on Earth is below 100 km</source>
            <translation>地球上的高程小于 100 km</translation>
        </message>
        <message>
            <source>an accuracy lies between 0 and 1000 km</source>
            <translation>精度在 0 到 1000 km 之间</translation>
        </message>
        <message>
            <source>no array moves at 1000 m/s</source>
            <translation>没有哪个设备会以 1000 m/s 移动</translation>
        </message>
        <message>
            <source>no air has 10 bar</source>
            <translation>大气压不会有 10 bar</translation>
        </message>
        <message>
            <source>no field has that temperature</source>
            <translation>野外不会有这样的温度</translation>
        </message>
        <message>
            <source>an angle is a few turns at most</source>
            <translation>角度最多是几圈</translation>
        </message>
        <message>
            <source>no hand bears 1000 g</source>
            <translation>手持设备承受不了 1000 g</translation>
        </message>
        <message>
            <source>no hand turns that fast</source>
            <translation>手不会转得那么快</translation>
        </message>
        <message>
            <source>no range finder sees 1000 km</source>
            <translation>没有哪个测距仪能测 1000 km</translation>
        </message>
        <message>
            <source>no range finder counts that far</source>
            <translation>没有哪个测距仪的强度有这么大</translation>
        </message>
        <message>
            <source>a flow quality lies between 0 and 255</source>
            <translation>光流质量在 0 到 255 之间</translation>
        </message>
        <message>
            <source>correct the value, or leave the field empty</source>
            <translation>请改正该值，或让字段留空</translation>
        </message>
        <message>
            <source>part the log there, or correct the time</source>
            <translation>请在那里把日志分开，或改正时间</translation>
        </message>
        <message>
            <source>only one of the columns lat_deg and lon_deg; the log has no positions</source>
            <translation>lat_deg 和 lon_deg 只有其中一列；日志没有位置</translation>
        </message>
        <message>
            <source>no marks</source>
            <translation>没有标志点</translation>
        </message>
        <message>
            <source>add the marks, or leave the file out of the project</source>
            <translation>请加入标志点，或从项目中去掉该文件</translation>
        </message>
        <message>
            <source>the mark has no name</source>
            <translation>标志点没有点名</translation>
        </message>
        <message>
            <source>keep one of the two rows</source>
            <translation>请只保留其中一行</translation>
        </message>
        <message>
            <source>ZERO is the zero point: (0, 0, 0) with role control</source>
            <translation>ZERO 是零点：坐标 (0, 0, 0)，作用为 control</translation>
        </message>
        <message>
            <source>give the mark another name</source>
            <translation>请给标志点另取名字</translation>
        </message>
        <message>
            <source>the row of ZERO is not used; it is always (0, 0, 0)</source>
            <translation>ZERO 行不会使用；它总是 (0, 0, 0)</translation>
        </message>
        <message>
            <source>give metres with a decimal dot</source>
            <translation>请以米为单位，用小数点写数</translation>
        </message>
        <message>
            <source>give metres from the zero point in the local frame, not map coordinates</source>
            <translation>请写局部坐标系中相对零点的米数，不要写地图坐标</translation>
        </message>
        <message>
            <source>write control or check</source>
            <translation>请写 control 或 check</translation>
        </message>
        <message>
            <source>the JSON is nested too deeply</source>
            <translation>JSON 嵌套太深</translation>
        </message>
        <message>
            <source>the JSON holds more than a million values</source>
            <translation>JSON 中的值超过一百万个</translation>
        </message>
        <message>
            <source>the project</source>
            <translation>项目</translation>
        </message>
        <message>
            <source>true or false</source>
            <translation>true 或 false</translation>
        </message>
        <message>
            <source>a number</source>
            <translation>数</translation>
        </message>
        <message>
            <source>a text</source>
            <translation>文本</translation>
        </message>
        <message>
            <source>a list</source>
            <translation>列表</translation>
        </message>
        <message>
            <source>an object</source>
            <translation>对象</translation>
        </message>
        <message>
            <source>null</source>
            <translation>null</translation>
        </message>
        <message>
            <source>give a text, or leave the key out</source>
            <translation>请写文本，或去掉这个键</translation>
        </message>
        <message>
            <source>write "fixed-point" or "area"</source>
            <translation>请写 "fixed-point" 或 "area"</translation>
        </message>
        <message>
            <source>use at most 64 letters, digits, '-', '_' and '.', the first one no '.'</source>
            <translation>请用最多 64 个字母、数字、“-”“_”“.”，第一个不能是“.”</translation>
        </message>
        <message>
            <source>a fixed-point run starts on a known mark</source>
            <translation>定点测线从已知标志点开始</translation>
        </message>
        <message>
            <source>a fixed-point run ends on a known mark</source>
            <translation>定点测线在已知标志点结束</translation>
        </message>
        <message>
            <source>give each run its own id</source>
            <translation>请给每条测线各自的编号</translation>
        </message>
        <message>
            <source>name at least one run with its log</source>
            <translation>请至少写一条测线及其日志</translation>
        </message>
        <message>
            <source>name a file in the project's folder, relative to it</source>
            <translation>请写项目文件夹内的文件，用相对路径</translation>
        </message>
        <message>
            <source>name the file with the marks under "control"</source>
            <translation>请在 "control" 下写控制点文件</translation>
        </message>
        <message>
            <source>add it to the control file, or correct the name</source>
            <translation>请把它加入控制点文件，或改正名字</translation>
        </message>
        <message>
            <source>times count like time_s of the log</source>
            <translation>时间与日志的 time_s 一样计</translation>
        </message>
        <message>
            <source>the survey has no name</source>
            <translation>测量没有名称</translation>
        </message>
        <message>
            <source>no log was given</source>
            <translation>没有给出日志</translation>
        </message>
        <message>
            <source>no file was given</source>
            <translation>没有给出文件</translation>
        </message>
        <message>
            <source>name the logs of the array, or their folder</source>
            <translation>请指定设备的日志，或日志所在的文件夹</translation>
        </message>
        <message>
            <source>name one table of marks</source>
            <translation>请只指定一张标志点表</translation>
        </message>
        <message>
            <source>no log has positions, so the zero point is not known</source>
            <translation>没有日志含位置，零点未知</translation>
        </message>
        <message>
            <source>say where it is: latitude, longitude and ellipsoidal height</source>
            <translation>请给出零点：纬度、经度和大地高</translation>
        </message>
        <message>
            <source>write survey.json into a folder above it, or put the file beside it</source>
            <translation>请把 survey.json 写到它的上级文件夹，或把该文件放到旁边</translation>
        </message>
        <message>
            <source>there is a survey already</source>
            <translation>那里已经有一个测量</translation>
        </message>
        <message>
            <source>name another file, or say that it may be replaced</source>
            <translation>请另取文件名，或允许替换</translation>
        </message>
        <message>
            <source>hard, soft, boundary or hole</source>
            <translation>应为 hard、soft、boundary 或 hole</translation>
        </message>
        <message>
            <source>give .gpkg, .shp, .geojson, .dxf or another vector format</source>
            <translation>请用 .gpkg、.shp、.geojson、.dxf 或其他矢量格式</translation>
        </message>
        <message>
            <source>the layers have different CRS</source>
            <translation>各图层的坐标系不同</translation>
        </message>
        <message>
            <source>bring them to one</source>
            <translation>请统一坐标系</translation>
        </message>
        <message>
            <source>there is no line or polygon in the file</source>
            <translation>文件中没有线或面</translation>
        </message>
        <message>
            <source>the raster has no place</source>
            <translation>栅格没有地理位置</translation>
        </message>
        <message>
            <source>the raster is not north-up</source>
            <translation>栅格不是北向上</translation>
        </message>
        <message>
            <source>warp it, e.g. with gdalwarp</source>
            <translation>请先重投影，例如用 gdalwarp</translation>
        </message>
        <message>
            <source>warp it, e.g. with gdalwarp -tr</source>
            <translation>请先重采样，例如用 gdalwarp -tr</translation>
        </message>
        <message>
            <source>cut out the part that is needed, e.g. with gdal_translate -projwin</source>
            <translation>请裁出需要的部分，例如用 gdal_translate -projwin</translation>
        </message>
        <message>
            <source>give an authority code such as EPSG:32649</source>
            <translation>请写 EPSG:32649 这样的代码</translation>
        </message>
        <message>
            <source>write a projected CRS in metres, for example "EPSG:32649", or leave "crs" out</source>
            <translation>请写以米为单位的投影坐标系，例如 "EPSG:32649"，或去掉 "crs"</translation>
        </message>
        <message>
            <source>write "local" (metres above the zero point) or "ellipsoid" (height above WGS 84)</source>
            <translation>请写 "local"（相对零点的米数）或 "ellipsoid"（WGS 84 大地高）</translation>
        </message>
        <message>
            <source>check zero_point in the project file</source>
            <translation>请检查项目文件中的 zero_point</translation>
        </message>
        <message>
            <source>walk farther</source>
            <translation>请多走一些</translation>
        </message>
        <message>
            <source>set surface.fixed_point_runs=true</source>
            <translation>请设 surface.fixed_point_runs=true</translation>
        </message>
        <message>
            <source>look at the log with `terrawalk inspect`</source>
            <translation>请用 `terrawalk inspect` 查看日志</translation>
        </message>
        <message>
            <source>choose a smaller surface.cell_m</source>
            <translation>请把 surface.cell_m 设得小一些</translation>
        </message>
        <message>
            <source>give a number</source>
            <translation>请写一个数</translation>
        </message>
        <message>
            <source>give a whole number</source>
            <translation>请写一个整数</translation>
        </message>
        <message>
            <source>a list or an object</source>
            <translation>列表或对象</translation>
        </message>
        <message>
            <source>the section "tuning" is not as `terrawalk tune` writes it</source>
            <translation>"tuning" 部分不是 `terrawalk tune` 写的样子</translation>
        </message>
        <message>
            <source>leave it as it was, or out</source>
            <translation>请保持原样，或去掉</translation>
        </message>
        <message>
            <source>format must be "terrawalk-config 1"</source>
            <translation>format 必须是 "terrawalk-config 1"</translation>
        </message>
        <message>
            <source>cannot be read</source>
            <translation>无法读取</translation>
        </message>
        <message>
            <source>check the path</source>
            <translation>请检查路径</translation>
        </message>
        <message>
            <source>is not valid JSON</source>
            <translation>不是有效的 JSON</translation>
        </message>
        <message>
            <source>holds a number that is too large</source>
            <translation>其中有过大的数</translation>
        </message>
        <message>
            <source>must hold one JSON object</source>
            <translation>必须是一个 JSON 对象</translation>
        </message>
        <message>
            <source>this is no list of earlier runs</source>
            <translation>这不是以往运行的列表</translation>
        </message>
        <message>
            <source>remove it: a new one is made</source>
            <translation>请删除它：程序会新建一个</translation>
        </message>
        <message>
            <source>no such format</source>
            <translation>没有这种格式</translation>
        </message>
        <message>
            <source>nothing to export</source>
            <translation>没有要导出的内容</translation>
        </message>
        <message>
            <source>choose heights of the same ground, in the same map frame</source>
            <translation>请选同一地面、同一地图坐标系的高程</translation>
        </message>
        <message>
            <source>warp it to the survey's map frame, e.g. with gdalwarp -t_srs</source>
            <translation>请重投影到测量的坐标系，例如用 gdalwarp -t_srs</translation>
        </message>
        <message>
            <source>choose another folder for the output</source>
            <translation>请另选输出文件夹</translation>
        </message>
        <message>
            <source>the output folder has no name</source>
            <translation>输出文件夹没有名字</translation>
        </message>
        <message>
            <source>choose a folder inside it</source>
            <translation>请选其中的一个文件夹</translation>
        </message>
        <message>
            <source>thin the points, or use a machine with more memory</source>
            <translation>请抽稀点，或换内存更大的机器</translation>
        </message>
        <message>
            <source>thin the points</source>
            <translation>请抽稀点</translation>
        </message>
        <message>
            <source>ask for a coarser resolution</source>
            <translation>请用更粗的分辨率</translation>
        </message>
        <message>
            <source>this is no JSON</source>
            <translation>这不是 JSON</translation>
        </message>
        <message>
            <source>the search has no points</source>
            <translation>搜索没有记录点</translation>
        </message>
        <message>
            <source>it tells of no search for parameters</source>
            <translation>其中没有参数搜索的记录</translation>
        </message>
        <message>
            <source>choose the CSV of an experiment that repeats searches, such as fig10</source>
            <translation>请选重复搜索的实验（如 fig10）的 CSV</translation>
        </message>
        <message>
            <source>the survey stands on fewer than two control marks beside ZERO</source>
            <translation>除 ZERO 外，停留过的控制点不足两个</translation>
        </message>
        <message>
            <source>stand on two or more, in stops or at the ends of fixed-point runs</source>
            <translation>请在两个以上的控制点上停留，或以定点测线到达</translation>
        </message>
        <message>
            <source>the survey has no fixed-point run between control marks</source>
            <translation>测量中没有控制点之间的定点测线</translation>
        </message>
        <message>
            <source>tuning needs runs of kind fixed_point whose target is a control mark</source>
            <translation>调参需要以控制点为终点的定点测线</translation>
        </message>
        <message>
            <source>raw sensors have no parameters to tune</source>
            <translation>原始传感器没有可调的参数</translation>
        </message>
        <message>
            <source>choose another --method</source>
            <translation>请另选方法</translation>
        </message>
        <message>
            <source>only method aukf has alpha, beta and kappa to tune</source>
            <translation>只有 aukf 方法有 alpha、beta、kappa 可调</translation>
        </message>
        <message>
            <source>continue it with --resume, or remove the file</source>
            <translation>请用 --resume 继续，或删除该文件</translation>
        </message>
        <message>
            <source>try other process noise, or --method ukf</source>
            <translation>请改用别的过程噪声，或用 ukf 方法</translation>
        </message>
        <message>
            <source>a log needs GNSS positions or velocities, or optical flow with heading</source>
            <translation>日志要有 GNSS 位置或速度，或带航向的光流</translation>
        </message>
        <message>
            <source>the adjustment of all runs has no solution</source>
            <translation>全部测线的联合平差无解</translation>
        </message>
        <message>
            <source>use --method ukf, or leave out the run that has no position</source>
            <translation>请用 ukf 方法，或去掉没有位置的测线</translation>
        </message>
        <message>
            <source>all pressures are alike, a scale cannot be fitted</source>
            <translation>所有气压相同，无法拟合比例</translation>
        </message>
        <message>
            <source>stand on marks of different height</source>
            <translation>请在高程不同的点上停留</translation>
        </message>
        <message>
            <source>the search has no limit</source>
            <translation>搜索没有上限</translation>
        </message>
        <message>
            <source>give the common vertex one height, or leave a gap between the lines</source>
            <translation>请给公共顶点同一高程，或让两线之间留空</translation>
        </message>
        <message>
            <source>give both a vertex there, of one height, or end one of them before</source>
            <translation>请在那里给两线同一高程的顶点，或让其中一条提前结束</translation>
        </message>
        <message>
            <source>no triangle is left within the boundary, outside the holes and below the longest edge</source>
            <translation>边界之内、孔洞之外、最长边以下没有剩下三角形</translation>
        </message>
        <message>
            <source>check the rings, or allow a longer edge</source>
            <translation>请检查边界和孔洞，或放宽最长边</translation>
        </message>
        <message>
            <source>there is no point to make a surface of</source>
            <translation>没有点可构成表面</translation>
        </message>
        <message>
            <source>use linear or clough-tocher</source>
            <translation>请用 linear 或 clough-tocher</translation>
        </message>
        <message>
            <source>bring both to one CRS</source>
            <translation>请统一两者的坐标系</translation>
        </message>
        <message>
            <source>the interval between contours must be above zero</source>
            <translation>等高距必须大于零</translation>
        </message>
        <message>
            <source>contours can be smoothed over 0 to 100 cells</source>
            <translation>等高线可在 0 到 100 个像元上平滑</translation>
        </message>
        <message>
            <source>choose a larger interval</source>
            <translation>请加大等高距</translation>
        </message>
        <message>
            <source>not enough memory for so many contours</source>
            <translation>内存不足以容纳这么多等高线</translation>
        </message>
        <message>
            <source>choose a larger interval or larger cells</source>
            <translation>请加大等高距或像元</translation>
        </message>
        <message>
            <source>no point lies within the hull of the others, so that no method can be judged</source>
            <translation>没有点落在其余点的范围之内，无法评判方法</translation>
        </message>
        <message>
            <source>choose a method by name</source>
            <translation>请按名称指定方法</translation>
        </message>
        <message>
            <source>walk several lines beside one another, and look at why ground points were rejected</source>
            <translation>请并排多走几条线，并查看地面点被剔除的原因</translation>
        </message>
        <message>
            <source>the longest edge of the surface's triangles may not be below zero</source>
            <translation>表面三角形的最长边不能小于零</translation>
        </message>
        <message>
            <source>give metres, or 0 to take it from the points</source>
            <translation>请以米为单位，0 表示由点推定</translation>
        </message>
        <message>
            <source>allow a longer edge, or 0 to take the limit from the points</source>
            <translation>请放宽最长边，或写 0 由点推定</translation>
        </message>
        <message>
            <source>ask for a resolution of a millimetre or more</source>
            <translation>请用一毫米或更粗的分辨率</translation>
        </message>
        <message>
            <source>there is no surface to make a grid of</source>
            <translation>没有可格网化的表面</translation>
        </message>
        <message>
            <source>a height needs at least one neighbour</source>
            <translation>求高程至少要一个相邻点</translation>
        </message>
        <message>
            <source>the power of the inverse distance must be above zero</source>
            <translation>反距离的幂必须大于零</translation>
        </message>
        <message>
            <source>there is no point to interpolate between</source>
            <translation>没有可内插的点</translation>
        </message>
        <message>
            <source>choose a greater spacing of its lattice, or another method</source>
            <translation>请加大格距，或换一种方法</translation>
        </message>
        <message>
            <source>too few points to learn how far interpolation is off</source>
            <translation>点太少，无法估计内插误差</translation>
        </message>
        <message>
            <source>too few points lie between others to learn how far interpolation is off</source>
            <translation>位于其他点之间的点太少，无法估计内插误差</translation>
        </message>
        <message>
            <source>walk farther, or keep more points</source>
            <translation>请多走一些，或多保留些点</translation>
        </message>
        <message>
            <source>not enough memory for the uncertainty of the grid</source>
            <translation>内存不足以计算格网的不确定度</translation>
        </message>
        <message>
            <source>take the times from its log</source>
            <translation>请按其日志填写时间</translation>
        </message>
        <message>
            <source>the zero mark is the survey's origin and cannot be left out</source>
            <translation>零点是测量的原点，不能去掉</translation>
        </message>
        <message>
            <source>edits leave no run</source>
            <translation>编辑后没有剩下测线</translation>
        </message>
        <message>
            <source>take one of them back</source>
            <translation>请撤销其中一项</translation>
        </message>
        <message>
            <source>choose larger voxels</source>
            <translation>请加大体素</translation>
        </message>
        <message>
            <source>the octree cannot be written</source>
            <translation>无法写入八叉树</translation>
        </message>
        <message>
            <source>the DEM has no cells</source>
            <translation>DEM 没有像元</translation>
        </message>
        <message>
            <source>no cell of the DEM has a height</source>
            <translation>DEM 的像元都没有高程</translation>
        </message>
        <message>
            <source>walk closer lines or choose larger cells</source>
            <translation>请加密测线，或加大像元</translation>
        </message>
        <message>
            <source>there is no ground point to write</source>
            <translation>没有地面点可写</translation>
        </message>
        <message>
            <source>the points reach farther than LAS can hold in steps of 0.1 mm</source>
            <translation>点的范围超出 LAS 以 0.1 mm 为步长能存储的范围</translation>
        </message>
        <message>
            <source>the surface has no triangle</source>
            <translation>表面没有三角形</translation>
        </message>
        <message>
            <source>the report's page cannot be laid out</source>
            <translation>无法排版报告页面</translation>
        </message>
        <message>
            <source>there is no contour to write</source>
            <translation>没有等高线可写</translation>
        </message>
        <message>
            <source>choose a smaller interval</source>
            <translation>请减小等高距</translation>
        </message>
        <message>
            <source>no known mark and no GNSS height: the ground below the start of the run is height 0</source>
            <translation>没有已知标志点和 GNSS 高程：以测线起点的地面为高程 0</translation>
        </message>
        <message>
            <source>no GNSS position and no start mark: the way to the first mark is placed backwards from it</source>
            <translation>没有 GNSS 位置和起点：到第一个点的路线由该点反推</translation>
        </message>
        <message>
            <source>no GNSS position and no known mark: the run starts at the origin, its place on the ground is unknown</source>
            <translation>没有 GNSS 位置和已知标志点：测线从原点开始，实地位置未知</translation>
        </message>
        <message>
            <source>no GNSS position</source>
            <translation>没有 GNSS 位置</translation>
        </message>
        <message>
            <source>no optical flow that could be rotated to the ground</source>
            <translation>没有可转到地面的光流</translation>
        </message>
        <message>
            <source>no barometer</source>
            <translation>没有气压计</translation>
        </message>
        <message>
            <source>no range finder: this run gives no ground points</source>
            <translation>没有测距仪：该测线不产生地面点</translation>
        </message>
        <message>
            <source>no accelerometer</source>
            <translation>没有加速度计</translation>
        </message>
        <message>
            <source>the log names no fix: every GNSS position counts as single</source>
            <translation>日志没有定位状态：所有 GNSS 位置按单点解处理</translation>
        </message>
        <message>
            <source>the paper's method starts on a known mark; this run names none</source>
            <translation>论文的方法从已知标志点开始；该测线没有指定</translation>
        </message>
        <message>
            <source>cancelled</source>
            <translation>已取消</translation>
        </message>
        <message>
            <source>name the mark, or make it an area walk</source>
            <translation>请指定标志点，或改为面积测线</translation>
        </message>
        <message>
            <source>give each run its own name</source>
            <translation>请给每条测线各自的名字</translation>
        </message>
        <message>
            <source>use letters, digits, '-', '_' and '.', the first one no '.'</source>
            <translation>请用字母、数字、“-”“_”“.”，第一个不能是“.”</translation>
        </message>
        <message>
            <source>correct the name, or give the table with that mark</source>
            <translation>请改正名字，或给出含该点的表</translation>
        </message>
        <message>
            <source>line %1: %2</source>
            <translation>第 %1 行：%2</translation>
        </message>
        <message>
            <source>control marks, %1</source>
            <translation>控制点：%1</translation>
        </message>
        <message>
            <source>marks, %1</source>
            <translation>标志点：%1</translation>
        </message>
        <message>
            <source>cannot open: %1</source>
            <translation>无法打开：%1</translation>
        </message>
        <message>
            <source>cannot read: %1</source>
            <translation>无法读取：%1</translation>
        </message>
        <message>
            <source>cannot write: %1</source>
            <translation>无法写入：%1</translation>
        </message>
        <message>
            <source>the file is larger than %1 MB</source>
            <translation>文件大于 %1 MB</translation>
        </message>
        <message>
            <source>the line is longer than %1 bytes</source>
            <translation>该行超过 %1 字节</translation>
        </message>
        <message>
            <source>%1 of %2 rows are out of order, more than %3 %; this is the first</source>
            <translation>%2 行中有 %1 行次序错乱，超过 %3 %；这是第一处</translation>
        </message>
        <message>
            <source>unknown metadata key %1 is not used</source>
            <translation>未知的元数据项 %1 不会使用</translation>
        </message>
        <message>
            <source>metadata key %1 stands twice</source>
            <translation>元数据项 %1 出现了两次</translation>
        </message>
        <message>
            <source>format is %1</source>
            <translation>格式是 %1</translation>
        </message>
        <message>
            <source>it must be %1</source>
            <translation>必须是 %1</translation>
        </message>
        <message>
            <source>start_utc %1 is no ISO 8601 time</source>
            <translation>start_utc %1 不是 ISO 8601 时间</translation>
        </message>
        <message>
            <source>sample_interval_s %1 is no positive number</source>
            <translation>sample_interval_s %1 不是正数</translation>
        </message>
        <message>
            <source>%1 %2 is no vector</source>
            <translation>%1 %2 不是向量</translation>
        </message>
        <message>
            <source>%1 %2 is longer than %3 m</source>
            <translation>%1 %2 长于 %3 m</translation>
        </message>
        <message>
            <source>%1 %2 has more than three numbers</source>
            <translation>%1 %2 多于三个数</translation>
        </message>
        <message>
            <source>column %1 has no name</source>
            <translation>第 %1 列没有列名</translation>
        </message>
        <message>
            <source>column %1 stands twice</source>
            <translation>列 %1 出现了两次</translation>
        </message>
        <message>
            <source>no format line; read as %1</source>
            <translation>没有格式行；按 %1 读取</translation>
        </message>
        <message>
            <source>column %1: the quotation mark is not closed</source>
            <translation>列 %1：引号没有闭合</translation>
        </message>
        <message>
            <source>column %1: %2 is no finite number</source>
            <translation>列 %1：%2 不是有限的数</translation>
        </message>
        <message>
            <source>%1 fields, but the header has %2 columns</source>
            <translation>有 %1 个字段，而标题行有 %2 列</translation>
        </message>
        <message>
            <source>more fields than the %1 columns of the header</source>
            <translation>字段多于标题行的 %1 列</translation>
        </message>
        <message>
            <source>column %1: %2</source>
            <translation>列 %1：%2</translation>
        </message>
        <message>
            <source>the clock jumps back from %1 s (line %2) to %3 s, more than %4 s</source>
            <translation>时钟从 %1 s（第 %2 行）跳回 %3 s，超过 %4 s</translation>
        </message>
        <message>
            <source>%1 rows give only one of latitude and longitude; their positions are taken as missing</source>
            <translation>%1 行只有纬度或只有经度；这些位置按缺失处理</translation>
        </message>
        <message>
            <source>unknown column %1 is kept as auxiliary</source>
            <translation>未知的列 %1 作为辅助列保留</translation>
        </message>
        <message>
            <source>unknown column %1 is kept as auxiliary; %2 of its fields are no numbers</source>
            <translation>未知的列 %1 作为辅助列保留；其中 %2 个字段不是数</translation>
        </message>
        <message>
            <source>unknown column %1 is not used</source>
            <translation>未知的列 %1 不会使用</translation>
        </message>
        <message>
            <source>no column %1</source>
            <translation>没有列 %1</translation>
        </message>
        <message>
            <source>the first row must name the columns %1</source>
            <translation>第一行必须写列名 %1</translation>
        </message>
        <message>
            <source>mark %1 stands twice, first on line %2</source>
            <translation>标志点 %1 出现了两次，第一次在第 %2 行</translation>
        </message>
        <message>
            <source>column %1: a sigma cannot be negative</source>
            <translation>列 %1：标准差不能为负</translation>
        </message>
        <message>
            <source>column %1: %2 is more than 100 km</source>
            <translation>列 %1：%2 超过 100 km</translation>
        </message>
        <message>
            <source>column role: %1 is no role</source>
            <translation>列 role：没有 %1 这种作用</translation>
        </message>
        <message>
            <source>no valid JSON: %1</source>
            <translation>不是有效的 JSON：%1</translation>
        </message>
        <message>
            <source>the key %1 stands twice in one object</source>
            <translation>键 %1 在同一对象中出现了两次</translation>
        </message>
        <message>
            <source>%1 must be an object, but is %2</source>
            <translation>%1 必须是对象，却是%2</translation>
        </message>
        <message>
            <source>%1 must be %2, but is %3</source>
            <translation>%1 必须是%2，却是%3</translation>
        </message>
        <message>
            <source>%1 is missing</source>
            <translation>缺少 %1</translation>
        </message>
        <message>
            <source>%1 is empty</source>
            <translation>%1 是空的</translation>
        </message>
        <message>
            <source>%1 is %2, outside %3 to %4</source>
            <translation>%1 的值 %2 不在 %3 到 %4 之内</translation>
        </message>
        <message>
            <source>%1 must be later than from_s</source>
            <translation>%1 必须晚于 from_s</translation>
        </message>
        <message>
            <source>%1 is %2, which cannot name files</source>
            <translation>%1 的值 %2 不能用作文件名</translation>
        </message>
        <message>
            <source>%1.kind is %2</source>
            <translation>%1.kind 是 %2</translation>
        </message>
        <message>
            <source>unknown key %1 is not used</source>
            <translation>未知的键 %1 不会使用</translation>
        </message>
        <message>
            <source>runs[%1].id: %2 is already the id of runs[%3] (line %4)</source>
            <translation>runs[%1].id：%2 已经是 runs[%3] 的编号（第 %4 行）</translation>
        </message>
        <message>
            <source>runs[%1] reads the same log as runs[%2]</source>
            <translation>runs[%1] 与 runs[%2] 读的是同一份日志</translation>
        </message>
        <message>
            <source>%1: %2 holds a control character</source>
            <translation>%1：%2 含有控制字符</translation>
        </message>
        <message>
            <source>%1: %2 is an absolute path</source>
            <translation>%1：%2 是绝对路径</translation>
        </message>
        <message>
            <source>%1: %2 leaves the project's folder</source>
            <translation>%1：%2 在项目文件夹之外</translation>
        </message>
        <message>
            <source>%1: %2 leads out of the project's folder by a link</source>
            <translation>%1：%2 经由链接指向项目文件夹之外</translation>
        </message>
        <message>
            <source>%1: %2 cannot be looked up: %3</source>
            <translation>%1：无法查找 %2：%3</translation>
        </message>
        <message>
            <source>%1: there is no mark %2</source>
            <translation>%1：没有标志点 %2</translation>
        </message>
        <message>
            <source>runs[%1].stops[%2]: %3 to %4 s is not within the log, %5 to %6 s</source>
            <translation>runs[%1].stops[%2]：%3 至 %4 s 不在日志的 %5 至 %6 s 之内</translation>
        </message>
        <message>
            <source>a log's header names %1 and sensors, one of marks %2</source>
            <translation>日志的标题行有 %1 和各传感器，标志点表的标题行是 %2</translation>
        </message>
        <message>
            <source>it lies outside the survey's folder %1</source>
            <translation>它不在测量的文件夹 %1 内</translation>
        </message>
        <message>
            <source>there is no run %1</source>
            <translation>没有测线 %1</translation>
        </message>
        <message>
            <source>%1 is of kind %2</source>
            <translation>%1 的类型是 %2</translation>
        </message>
        <message>
            <source>GDAL reads no lines from this file: %1</source>
            <translation>GDAL 无法从该文件读取线：%1</translation>
        </message>
        <message>
            <source>the file cannot be read to its end: %1</source>
            <translation>文件无法读到末尾：%1</translation>
        </message>
        <message>
            <source>the cells are not square: %1 x %2</source>
            <translation>像元不是正方形：%1 x %2</translation>
        </message>
        <message>
            <source>the raster cannot be read: %1</source>
            <translation>无法读取栅格：%1</translation>
        </message>
        <message>
            <source>GDAL reads no raster from this file: %1</source>
            <translation>GDAL 无法从该文件读取栅格：%1</translation>
        </message>
        <message>
            <source>not enough memory for %1 x %2 cells</source>
            <translation>内存不足以容纳 %1 x %2 个像元</translation>
        </message>
        <message>
            <source>%1 is no CRS that PROJ knows</source>
            <translation>PROJ 不认识坐标系 %1</translation>
        </message>
        <message>
            <source>vertical datum "%1" is not supported</source>
            <translation>不支持高程基准 "%1"</translation>
        </message>
        <message>
            <source>CRS "%1" is geographic: its axes are degrees, and a terrain model needs metres</source>
            <translation>坐标系 "%1" 是地理坐标系：单位是度，而地形模型需要米</translation>
        </message>
        <message>
            <source>CRS "%1" is geocentric: it has no east and north axes</source>
            <translation>坐标系 "%1" 是地心坐标系：没有东、北轴</translation>
        </message>
        <message>
            <source>CRS "%1" has a vertical part, which is not supported yet: write the horizontal CRS alone (the part before the "+") and "vertical_datum": "ellipsoid" or "local"</source>
            <translation>坐标系 "%1" 含高程部分，尚不支持：请只写平面坐标系（“+”之前的部分），并写 "vertical_datum": "ellipsoid" 或 "local"</translation>
        </message>
        <message>
            <source>CRS "%1" is vertical only</source>
            <translation>坐标系 "%1" 只有高程</translation>
        </message>
        <message>
            <source>CRS "%1" is not a projected CRS</source>
            <translation>坐标系 "%1" 不是投影坐标系</translation>
        </message>
        <message>
            <source>CRS "%1" is not known (%2)</source>
            <translation>坐标系 "%1" 未知（%2）</translation>
        </message>
        <message>
            <source>CRS "%1" does not describe a coordinate reference system</source>
            <translation>"%1" 不是坐标参考系</translation>
        </message>
        <message>
            <source>CRS "%1" has axes in %2, not in metres</source>
            <translation>坐标系 "%1" 的单位是 %2，不是米</translation>
        </message>
        <message>
            <source>CRS "%1" has axes that point %2 and %3, not east and north</source>
            <translation>坐标系 "%1" 的轴指向 %2 和 %3，不是东和北</translation>
        </message>
        <message>
            <source>Positions go from WGS 84 to the datum of %1 by "%2", which is good to about %3 m.</source>
            <translation>位置经 "%2" 从 WGS 84 转到 %1 的基准，精度约 %3 m。</translation>
        </message>
        <message>
            <source>PROJ knows no transformation from WGS 84 to the datum of %1; the two are taken as one, which may be wrong by a metre or so.</source>
            <translation>PROJ 没有从 WGS 84 到 %1 基准的转换；两者按相同处理，可能差一米左右。</translation>
        </message>
        <message>
            <source>The zero point lies outside the area that the CRS is made for (lat %1 to %2, lon %3 to %4).</source>
            <translation>零点不在该坐标系的适用范围内（纬度 %1 至 %2，经度 %3 至 %4）。</translation>
        </message>
        <message>
            <source>In %1 1 m on the ground is %2 m on the map here; lengths, areas and slopes taken from the map are wrong by that factor.</source>
            <translation>在 %1 中，此处地面 1 m 对应图上 %2 m；从图上量取的长度、面积和坡度都有这一比例的偏差。</translation>
        </message>
        <message>
            <source>the GNSS positions of run %1 lie %2 km from the zero point</source>
            <translation>测线 %1 的 GNSS 位置离零点 %2 km</translation>
        </message>
        <message>
            <source>%1 epochs in all give too few ground points for a surface</source>
            <translation>总共 %1 个历元，地面点太少，无法生成表面</translation>
        </message>
        <message>
            <source>the survey gives too few ground points for a surface (most frequent reason: %1, %2 of %3 epochs)</source>
            <translation>地面点太少，无法生成表面（最常见的原因：%1，%3 个历元中有 %2 个）</translation>
        </message>
        <message>
            <source>no cell of %1 m has its centre on the surface</source>
            <translation>没有 %1 m 像元的中心落在表面上</translation>
        </message>
        <message>
            <source>%1 = %2 is not permitted</source>
            <translation>%1 = %2 不允许</translation>
        </message>
        <message>
            <source>permitted: %1</source>
            <translation>允许：%1</translation>
        </message>
        <message>
            <source>give a list: %1</source>
            <translation>请写一个列表：%1</translation>
        </message>
        <message>
            <source>item %1 of %2 is not permitted</source>
            <translation>%2 的第 %1 项不允许</translation>
        </message>
        <message>
            <source>unknown parameter '%1'</source>
            <translation>未知的参数 '%1'</translation>
        </message>
        <message>
            <source>did you mean %1? `terrawalk config describe` lists all</source>
            <translation>是不是 %1？`terrawalk config describe` 列出全部参数</translation>
        </message>
        <message>
            <source>%1 and this surface have no place in common</source>
            <translation>%1 与当前表面没有重叠处</translation>
        </message>
        <message>
            <source>the CRS is %1, that of the survey %2</source>
            <translation>坐标系是 %1，测量的坐标系是 %2</translation>
        </message>
        <message>
            <source>heights are in %1, those of the survey in %2</source>
            <translation>高程单位是 %1，测量的单位是 %2</translation>
        </message>
        <message>
            <source>the survey %1 lies in the output folder %2</source>
            <translation>测量 %1 位于输出文件夹 %2 中</translation>
        </message>
        <message>
            <source>the output folder %1 is a file</source>
            <translation>输出文件夹 %1 是一个文件</translation>
        </message>
        <message>
            <source>the output folder %1 holds something else than an earlier output: %2</source>
            <translation>输出文件夹 %1 中有不属于以往输出的内容：%2</translation>
        </message>
        <message>
            <source>the output folder %1 is a symbolic link that leads nowhere</source>
            <translation>输出文件夹 %1 是指向空处的符号链接</translation>
        </message>
        <message>
            <source>the output folder %1 is the root of the file system</source>
            <translation>输出文件夹 %1 是文件系统的根</translation>
        </message>
        <message>
            <source>the output folder %1 is the current folder or one around it, which cannot be replaced</source>
            <translation>输出文件夹 %1 是当前文件夹或其上级，不能替换</translation>
        </message>
        <message>
            <source>the output folder %1 is a mount point, which cannot be replaced</source>
            <translation>输出文件夹 %1 是挂载点，不能替换</translation>
        </message>
        <message>
            <source>cannot look at the output folder: %1</source>
            <translation>无法查看输出文件夹：%1</translation>
        </message>
        <message>
            <source>cannot read the output folder: %1</source>
            <translation>无法读取输出文件夹：%1</translation>
        </message>
        <message>
            <source>cannot find the output folder: %1</source>
            <translation>找不到输出文件夹：%1</translation>
        </message>
        <message>
            <source>cannot make the output folder: %1</source>
            <translation>无法建立输出文件夹：%1</translation>
        </message>
        <message>
            <source>cannot make the folder: %1</source>
            <translation>无法建立文件夹：%1</translation>
        </message>
        <message>
            <source>cannot put the output in place: %1</source>
            <translation>无法把输出放到位：%1</translation>
        </message>
        <message>
            <source>cannot put the previous output aside: %1</source>
            <translation>无法移开以往的输出：%1</translation>
        </message>
        <message>
            <source>cannot put the previous output back: %1</source>
            <translation>无法放回以往的输出：%1</translation>
        </message>
        <message>
            <source>cannot remove: %1</source>
            <translation>无法删除：%1</translation>
        </message>
        <message>
            <source>a surface of %1 points and %2 cells needs about %3 of memory, and %4 can be had</source>
            <translation>%1 个点、%2 个像元的表面约需内存 %3，可用 %4</translation>
        </message>
        <message>
            <source>%1: about %2 of memory are needed, and %3 can be had</source>
            <translation>%1：约需内存 %2，可用 %3</translation>
        </message>
        <message>
            <source>ask for a resolution of %1 or coarser, or for a smaller extent</source>
            <translation>请用 %1 或更粗的分辨率，或缩小范围</translation>
        </message>
        <message>
            <source>%1 holds the losses of an interrupted tuning</source>
            <translation>%1 是中断的调参留下的记录</translation>
        </message>
        <message>
            <source>run %1: the smoother failed at %2 s</source>
            <translation>测线 %1：平滑在 %2 s 处失败</translation>
        </message>
        <message>
            <source>run %1: the filter diverged %2 s after its start</source>
            <translation>测线 %1：滤波在开始 %2 s 后发散</translation>
        </message>
        <message>
            <source>run %1: the log has no epochs</source>
            <translation>测线 %1：日志没有历元</translation>
        </message>
        <message>
            <source>run %1: nothing in the log tells a position</source>
            <translation>测线 %1：日志中没有能给出位置的内容</translation>
        </message>
        <message>
            <source>a pressure-to-height fit needs at least two readings, there are %1</source>
            <translation>气压与高程的拟合至少要两个读数，现有 %1 个</translation>
        </message>
        <message>
            <source>a population of %1 individuals</source>
            <translation>种群有 %1 个个体</translation>
        </message>
        <message>
            <source>take %1 to %2</source>
            <translation>请取 %1 到 %2</translation>
        </message>
        <message>
            <source>%1 has too few vertices at different places</source>
            <translation>%1 的不同位置的顶点太少</translation>
        </message>
        <message>
            <source>%1 has a vertex that is no place on Earth</source>
            <translation>%1 有一个顶点不是地球上的位置</translation>
        </message>
        <message>
            <source>%1 and %2 meet at %3, %4 at heights of %5 and %6</source>
            <translation>%1 与 %2 在 %3, %4 处相遇，高程为 %5 和 %6</translation>
        </message>
        <message>
            <source>%1 and %2 cross at %3, %4</source>
            <translation>%1 与 %2 在 %3, %4 处相交</translation>
        </message>
        <message>
            <source>%1 crosses itself at %2, %3</source>
            <translation>%1 在 %2, %3 处自相交</translation>
        </message>
        <message>
            <source>%1 places in plan, all on one line or too few, make no surface</source>
            <translation>平面上的 %1 个位置太少或都在一条直线上，不能构成表面</translation>
        </message>
        <message>
            <source>not enough memory to triangulate %1 points</source>
            <translation>内存不足以对 %1 个点做三角剖分</translation>
        </message>
        <message>
            <source>the triangulation failed: %1</source>
            <translation>三角剖分失败：%1</translation>
        </message>
        <message>
            <source>method %1 cannot follow breaklines</source>
            <translation>方法 %1 不能顾及断裂线</translation>
        </message>
        <message>
            <source>the breaklines are in %1, the points in %2</source>
            <translation>断裂线的坐标系是 %1，点的坐标系是 %2</translation>
        </message>
        <message>
            <source>heights from %1 to %2 make more than %3 levels</source>
            <translation>从 %1 到 %2 的高程超过 %3 层</translation>
        </message>
        <message>
            <source>%1 points are too few for cross-validation</source>
            <translation>%1 个点太少，无法交叉验证</translation>
        </message>
        <message>
            <source>%1 ground points are more than a surface can hold</source>
            <translation>%1 个地面点超过表面可容纳的数量</translation>
        </message>
        <message>
            <source>a surface needs at least three ground points at different places, there are %1</source>
            <translation>表面至少要三个不同位置的地面点，现有 %1 个</translation>
        </message>
        <message>
            <source>all %1 ground points lie on one straight line</source>
            <translation>%1 个地面点都在一条直线上</translation>
        </message>
        <message>
            <source>no triangle between the ground points has all edges within %1 m</source>
            <translation>没有三边都在 %1 m 以内的三角形</translation>
        </message>
        <message>
            <source>a cell of %1 m is none</source>
            <translation>%1 m 的像元无效</translation>
        </message>
        <message>
            <source>cells of %1 m make a grid of %2 x %3, above the limit of %4 cells</source>
            <translation>%1 m 的像元构成 %2 x %3 的格网，超过 %4 个像元的上限</translation>
        </message>
        <message>
            <source>ask for a resolution of %1 m or coarser, or look for stray points far from the others</source>
            <translation>请用 %1 m 或更粗的分辨率，或检查远离其他点的孤点</translation>
        </message>
        <message>
            <source>not enough memory for a grid of %1 x %2 cells</source>
            <translation>内存不足以容纳 %1 x %2 的格网</translation>
        </message>
        <message>
            <source>not enough memory to interpolate between %1 points</source>
            <translation>内存不足以对 %1 个点内插</translation>
        </message>
        <message>
            <source>a B-spline over these points needs %1 control points</source>
            <translation>这些点的 B 样条需要 %1 个控制点</translation>
        </message>
        <message>
            <source>the points cannot be cleaned: %1</source>
            <translation>无法清理这些点：%1</translation>
        </message>
        <message>
            <source>ground point %1 of %2 is no place on Earth: %3</source>
            <translation>%2 个地面点中的第 %1 个不是地球上的位置：%3</translation>
        </message>
        <message>
            <source>edits name run '%1', which the survey lacks</source>
            <translation>编辑中的测线 '%1' 不在测量中</translation>
        </message>
        <message>
            <source>edits name mark '%1', which the survey lacks</source>
            <translation>编辑中的点 '%1' 不在测量中</translation>
        </message>
        <message>
            <source>run %1 has no records between %2 and %3 s</source>
            <translation>测线 %1 在 %2 至 %3 s 之间没有记录</translation>
        </message>
        <message>
            <source>rays reach farther than %1 m from the origin of the tree</source>
            <translation>射线离八叉树原点超过 %1 m</translation>
        </message>
        <message>
            <source>the DEM cannot hold the height %1 m</source>
            <translation>DEM 无法存储高程 %1 m</translation>
        </message>
        <message>
            <source>cannot make the DEM: %1</source>
            <translation>无法建立 DEM：%1</translation>
        </message>
        <message>
            <source>cannot describe the DEM: %1</source>
            <translation>无法写入 DEM 的说明：%1</translation>
        </message>
        <message>
            <source>cannot write the DEM: %1</source>
            <translation>无法写入 DEM：%1</translation>
        </message>
        <message>
            <source>the DEM just written does not read back: %1</source>
            <translation>刚写入的 DEM 读回时不一致：%1</translation>
        </message>
        <message>
            <source>cannot make the DEM's overviews: %1</source>
            <translation>无法建立 DEM 的金字塔：%1</translation>
        </message>
        <message>
            <source>GDAL does not understand the CRS of the DEM: %1</source>
            <translation>GDAL 不认识 DEM 的坐标系：%1</translation>
        </message>
        <message>
            <source>LAS cannot hold the CRS: %1</source>
            <translation>LAS 无法存储坐标系：%1</translation>
        </message>
        <message>
            <source>cannot make the PDF: %1</source>
            <translation>无法生成 PDF：%1</translation>
        </message>
        <message>
            <source>cannot write the lines: %1</source>
            <translation>无法写入线：%1</translation>
        </message>
        <message>
            <source>the picture cannot be encoded: %1</source>
            <translation>无法编码图片：%1</translation>
        </message>
        <message>
            <source>no known mark, GNSS height or range at the start: the array is taken to start %1 m above height 0</source>
            <translation>起点没有已知标志点、GNSS 高程或测距：设备起始高度取高程 0 以上 %1 m</translation>
        </message>
        <message>
            <source>no GNSS position in the first %1 s, so the start is less sure</source>
            <translation>最初 %1 s 没有 GNSS 位置，起点较不确定</translation>
        </message>
        <message>
            <source>no GNSS position for %1 s</source>
            <translation>有 %1 s 没有 GNSS 位置</translation>
        </message>
        <message>
            <source>no heading in %1 GNSS epochs: the horizontal lever arm of the antenna is not removed there but counted as variance</source>
            <translation>%1 个 GNSS 历元没有航向：那里未改正天线的水平杆臂，而是计入方差</translation>
        </message>
        <message>
            <source>GNSS is %1 m away from mark %2 on which the array stands at %3 s: check the name and the coordinates of the mark</source>
            <translation>设备在 %3 s 停于标志点 %2，GNSS 却相距 %1 m：请检查点名和坐标</translation>
        </message>
        <message>
            <source>the barometer puts mark %1 %2 m above its height at %3 s: check the name and the coordinates of the mark</source>
            <translation>气压计在 %3 s 测得标志点 %1 高出已知高程 %2 m：请检查点名和坐标</translation>
        </message>
        <message>
            <source>the barometer puts mark %1 %2 m below its height at %3 s: check the name and the coordinates of the mark</source>
            <translation>气压计在 %3 s 测得标志点 %1 低于已知高程 %2 m：请检查点名和坐标</translation>
        </message>
        <message>
            <source>%1: only %2 of %3 readings were used</source>
            <translation>%1：%3 个读数中只用了 %2 个</translation>
        </message>
        <message>
            <source>optical flow bridged by its recent mean for %1 s in all</source>
            <translation>光流缺失处用近期均值代替，共 %1 s</translation>
        </message>
        <message>
            <source>a sensor that had been rejected for long was let in again %1 times; the track may be off before that</source>
            <translation>长期被拒的传感器重新启用了 %1 次；此前的航迹可能有偏差</translation>
        </message>
        <message>
            <source>%1 missing in %2 of %3 epochs; the last value is held</source>
            <translation>%1 在 %3 个历元中缺失 %2 个；沿用前值</translation>
        </message>
        <message>
            <source>%1 ended on its lower bound %2: the data ask for more than the box allows, or say nothing of it</source>
            <translation>%1 停在下界 %2：数据要求超出范围，或数据不能确定它</translation>
        </message>
        <message>
            <source>%1 ended on its upper bound %2: the data ask for more than the box allows, or say nothing of it</source>
            <translation>%1 停在上界 %2：数据要求超出范围，或数据不能确定它</translation>
        </message>
        <message>
            <source>the data cannot tell %1 apart from %2 to %3: the loss changes by less than %4 % in between</source>
            <translation>数据无法在 %2 至 %3 之间分辨 %1：其间损失的变化小于 %4 %</translation>
        </message>
        <message>
            <source>%1 points lay within %2 of another or of a breakline</source>
            <translation>%1 个点与其他点或断裂线的距离在 %2 以内</translation>
        </message>
        <message>
            <source>no cross-validation: %1</source>
            <translation>没有交叉验证：%1</translation>
        </message>
        <message>
            <source>the fixed-point run %1 has no target mark</source>
            <translation>定点测线 %1 没有终点标志</translation>
        </message>
        <message>
            <source>the fixed-point run %1 has no start mark</source>
            <translation>定点测线 %1 没有起点标志</translation>
        </message>
        <message>
            <source>two runs are named %1</source>
            <translation>有两条测线都叫 %1</translation>
        </message>
        <message>
            <source>%1 cannot be the name of a run</source>
            <translation>%1 不能作测线名</translation>
        </message>
        <message>
            <source>run %1 names the mark %2, which is not known</source>
            <translation>测线 %1 指定的标志点 %2 未知</translation>
        </message>
        <message>
            <source>%1; %2</source>
            <translation>%1；%2</translation>
        </message>
        <message>
            <source>%1: %2</source>
            <translation>%1：%2</translation>
        </message>
        <message>
            <source>the system of equations holds a number that is not finite</source>
            <translation>方程组中有非有限的数</translation>
        </message>
        <message>
            <source>the system of equations is not positive definite</source>
            <translation>方程组不是正定的</translation>
        </message>
        <message>
            <source>the longest edge may not be below zero</source>
            <translation>最长边不能小于零</translation>
        </message>
        <message>
            <source>the distance of points that become one may not be below zero</source>
            <translation>合并点的距离不能小于零</translation>
        </message>
        <message>
            <source>cross-validation needs at least two folds</source>
            <translation>交叉验证至少要两折</translation>
        </message>
        <message>
            <source>the side of a block may not be below zero</source>
            <translation>分块的边长不能小于零</translation>
        </message>
        <message>
            <source>the extent has no area</source>
            <translation>范围没有面积</translation>
        </message>
        <message>
            <source>the spacing of the B-spline's finest lattice must be at least 0.05</source>
            <translation>B 样条最细格距至少为 0.05</translation>
        </message>
        <message>
            <source>statistical outliers need at least one neighbour and sigmas not below zero</source>
            <translation>统计离群点至少要一个相邻点，且标准差倍数不小于零</translation>
        </message>
        <message>
            <source>radius outliers need a radius above zero and at least one neighbour</source>
            <translation>半径离群点要求半径大于零且至少一个相邻点</translation>
        </message>
        <message>
            <source>sizes and heights of what stands above the ground must be above zero, the greatest not below the least, the window not above 1000 cells</source>
            <translation>地面以上物体的尺寸和高度必须大于零，最大值不小于最小值，窗口不超过 1000 个像元</translation>
        </message>
        <message>
            <source>voxels and ranges must be above zero</source>
            <translation>体素和距离必须大于零</translation>
        </message>
        <message>
            <source>the least and greatest of a terrace edge must be above zero</source>
            <translation>梯田坎的最小值和最大值必须大于零</translation>
        </message>
        <message>
            <source>the surface has more vertices or triangles than a mesh file can count</source>
            <translation>表面的顶点或三角形超过网格文件可计的数量</translation>
        </message>
        <message>
            <source>more runs than LAS can number</source>
            <translation>测线数超过 LAS 可编号的数量</translation>
        </message>
        <message>
            <source>GDAL was built without GeoPackage</source>
            <translation>GDAL 不支持 GeoPackage</translation>
        </message>
        <message>
            <source>cannot write a feature</source>
            <translation>无法写入要素</translation>
        </message>
        <message>
            <source>cannot write the points</source>
            <translation>无法写入点</translation>
        </message>
        <message>
            <source>cannot make polygons</source>
            <translation>无法生成面</translation>
        </message>
        <message>
            <source>name a file .gpkg, .geojson or .dxf</source>
            <translation>请用 .gpkg、.geojson 或 .dxf 文件名</translation>
        </message>
        <message>
            <source>no colours or no heights to show</source>
            <translation>没有可显示的颜色或高程</translation>
        </message>
        <message>
            <source>OpenSSL offers no SHA-256 on this machine</source>
            <translation>本机的 OpenSSL 不提供 SHA-256</translation>
        </message>
        <message>
            <source>the DEM has no standard errors</source>
            <translation>DEM 没有标准差</translation>
        </message>
        <message>
            <source>this is no folder that `terrawalk process` wrote</source>
            <translation>这不是 `terrawalk process` 写的文件夹</translation>
        </message>
        <message>
            <source>process the survey first</source>
            <translation>请先处理测量</translation>
        </message>
        <message>
            <source>the system of equations does not determine unknown %1</source>
            <translation>方程组无法确定未知数 %1</translation>
        </message>
        <message>
            <source>no barometric height for a pressure of %1 Pa at %2 m</source>
            <translation>气压 %1 Pa、高程 %2 m 处无法求气压高</translation>
        </message>
        <message>
            <source>GDAL has no driver %1</source>
            <translation>GDAL 没有驱动 %1</translation>
        </message>
        <message>
            <source>cannot make the layer %1</source>
            <translation>无法建立图层 %1</translation>
        </message>
        <message>
            <source>cannot make the field %1</source>
            <translation>无法建立字段 %1</translation>
        </message>
        <message>
            <source>contours cannot be written as %1</source>
            <translation>等高线不能写成 %1</translation>
        </message>
        <message>
            <source>cannot write the project: %1</source>
            <translation>无法写入项目：%1</translation>
        </message>
        <message>
            <source>a drawing: %1</source>
            <translation>图：%1</translation>
        </message>
        <message>
            <source>GDAL names no reason</source>
            <translation>GDAL 没有说明原因</translation>
        </message>
        <message>
            <source>write %1</source>
            <translation>请写 %1</translation>
        </message>
        <message>
            <source>permitted: %1 to %2</source>
            <translation>允许：%1 到 %2</translation>
        </message>
        <message>
            <source>column %1: %2: %3</source>
            <translation>列 %1：%2：%3</translation>
        </message>
        <message>
            <source>%1 – survey report</source>
            <translation>%1 – 测量报告</translation>
        </message>
        <message>
            <source>Unnamed survey</source>
            <translation>未命名的测量</translation>
        </message>
        <message>
            <source>Terrain survey: what was made and how far to trust it. Terrawalk %1.</source>
            <translation>地形测量：成果及其可信程度。Terrawalk %1。</translation>
        </message>
        <message>
            <source>Map</source>
            <translation>地图</translation>
        </message>
        <message>
            <source>Errors</source>
            <translation>误差</translation>
        </message>
        <message>
            <source>Accuracy</source>
            <translation>精度</translation>
        </message>
        <message>
            <source>Runs</source>
            <translation>测线</translation>
        </message>
        <message>
            <source>Sensors</source>
            <translation>传感器</translation>
        </message>
        <message>
            <source>Record</source>
            <translation>处理记录</translation>
        </message>
        <message>
            <source>What could not be checked</source>
            <translation>未能检核的内容</translation>
        </message>
        <message>
            <source>Nothing that the program knows of.</source>
            <translation>就程序所知，没有。</translation>
        </message>
        <message>
            <source>Warnings</source>
            <translation>警告</translation>
        </message>
        <message>
            <source>This machine has no font for Chinese, so this file is in English; report.html is in Chinese. On Debian install fonts-wqy-microhei.</source>
            <translation>本机没有中文字体，因此本文件为英文；report.html 为中文。在 Debian 上请安装 fonts-wqy-microhei。</translation>
        </message>
        <message>
            <source>Map of the walk</source>
            <translation>行走地图</translation>
        </message>
        <message>
            <source>Neither a track nor a mark has a position to draw.</source>
            <translation>没有可绘制位置的轨迹或标志点。</translation>
        </message>
        <message>
            <source>Local frame, both axes to one scale.</source>
            <translation>局部坐标系，两轴比例相同。</translation>
        </message>
        <message>
            <source>Local frame, both axes to one scale. Bars at the marks: height error of the %1.</source>
            <translation>局部坐标系，两轴比例相同。标志点处的竖条：高程误差（%1）。</translation>
        </message>
        <message>
            <source>ground below the array</source>
            <translation>阵列下方地面</translation>
        </message>
        <message>
            <source>Errors at the marks</source>
            <translation>标志点处的误差</translation>
        </message>
        <message>
            <source>Height of the surface at each mark less the mark's own: made from the sensors as they are, and after fusion.</source>
            <translation>各标志点处曲面高程减标志点高程：用传感器原始数据生成的，以及融合后的。</translation>
        </message>
        <message>
            <source>Height of the nearest ground point less the mark's own, before and after fusion.</source>
            <translation>最近地面点高程减标志点高程，融合前后。</translation>
        </message>
        <message>
            <source>Position below the array less the mark, seen from above.</source>
            <translation>阵列下方位置减标志点位置，俯视。</translation>
        </message>
        <message>
            <source>Height error of the %1 at %2 marks. The upright line is zero.</source>
            <translation>%2点处的高程误差（%1）。竖线为零。</translation>
        </message>
        <message>
            <source>Fewer than five comparisons: a histogram would show nothing.</source>
            <translation>比较不足五次：直方图没有意义。</translation>
        </message>
        <message>
            <source>Ground height below the array less the mark's, at each stand on a mark.</source>
            <translation>每次在标志点上静站时，阵列下方地面高程减标志点高程。</translation>
        </message>
        <message>
            <source>There is nothing to draw: no mark was compared with the product.</source>
            <translation>没有可绘制的内容：没有标志点与成果比较。</translation>
        </message>
        <message>
            <source>Marks</source>
            <translation>标志点数</translation>
        </message>
        <message>
            <source>Mean</source>
            <translation>平均值</translation>
        </message>
        <message>
            <source>SD</source>
            <translation>标准差</translation>
        </message>
        <message>
            <source>95 % interval of RMSE</source>
            <translation>RMSE 的 95 % 区间</translation>
        </message>
        <message>
            <source>Largest</source>
            <translation>最大值</translation>
        </message>
        <message>
            <source>Median</source>
            <translation>中位数</translation>
        </message>
        <message>
            <source>95 % interval</source>
            <translation>95 % 区间</translation>
        </message>
        <message>
            <source>68.3 % of |d| below</source>
            <translation>68.3 % 的 |d| 小于</translation>
        </message>
        <message>
            <source>95 % of |d| below</source>
            <translation>95 % 的 |d| 小于</translation>
        </message>
        <message>
            <source>Compared</source>
            <translation>比较对象</translation>
        </message>
        <message>
            <source>Axis</source>
            <translation>轴</translation>
        </message>
        <message>
            <source>east</source>
            <translation>东</translation>
        </message>
        <message>
            <source>north</source>
            <translation>北</translation>
        </message>
        <message>
            <source>up</source>
            <translation>高程</translation>
        </message>
        <message>
            <source>horizontal</source>
            <translation>平面</translation>
        </message>
        <message>
            <source>By the ground at the check marks</source>
            <translation>按检核点处的地面分类</translation>
        </message>
        <message>
            <source>Height errors of the surface. Slopes are its own, over a metre; 10 % is the limit that the ASPRS standard sets for check marks.</source>
            <translation>曲面的高程误差。坡度由曲面在一米范围内求得；10 % 是 ASPRS 标准对检核点规定的限值。</translation>
        </message>
        <message>
            <source>Ground</source>
            <translation>地面</translation>
        </message>
        <message>
            <source>tread, slope below 10 %</source>
            <translation>台面，坡度小于 10 %</translation>
        </message>
        <message>
            <source>slope of 10 to 30 %</source>
            <translation>坡度 10 至 30 %</translation>
        </message>
        <message>
            <source>riser, slope of 30 % and more</source>
            <translation>田坎，坡度 30 % 及以上</translation>
        </message>
        <message>
            <source>open</source>
            <translation>开阔</translation>
        </message>
        <message>
            <source>vegetated</source>
            <translation>植被</translation>
        </message>
        <message>
            <source>Accuracy at 95 % confidence (NSSDA)</source>
            <translation>95 % 置信水平下的精度（NSSDA）</translation>
        </message>
        <message>
            <source>FGDC-STD-007.3-1998, errors taken for normal and unbiased: vertical 1.9600 RMSE; horizontal 1.7308 times the RMSE of the distance, or 2.4477 times the mean RMSE of both axes where they differ; nothing where one is below 0.6 of the other. The standard asks for 20 check marks.</source>
            <translation>FGDC-STD-007.3-1998，假定误差服从正态分布且无偏：高程为 RMSE 的 1.9600 倍；平面为距离 RMSE 的 1.7308 倍，两轴不同时为两轴 RMSE 平均值的 2.4477 倍；一轴小于另一轴的 0.6 倍时不给出。该标准要求 20 个检核点。</translation>
        </message>
        <message>
            <source>Stage</source>
            <translation>阶段</translation>
        </message>
        <message>
            <source>Vertical</source>
            <translation>高程</translation>
        </message>
        <message>
            <source>Horizontal</source>
            <translation>平面</translation>
        </message>
        <message>
            <source>no, used</source>
            <translation>否，已用于估计</translation>
        </message>
        <message>
            <source>yes, a possible blunder</source>
            <translation>是，可能是粗差</translation>
        </message>
        <message>
            <source>yes</source>
            <translation>是</translation>
        </message>
        <message>
            <source>Mark</source>
            <translation>标志点</translation>
        </message>
        <message>
            <source>Role</source>
            <translation>类型</translation>
        </message>
        <message>
            <source>Run</source>
            <translation>测线</translation>
        </message>
        <message>
            <source>East [m]</source>
            <translation>东 [m]</translation>
        </message>
        <message>
            <source>North [m]</source>
            <translation>北 [m]</translation>
        </message>
        <message>
            <source>Up [m]</source>
            <translation>高程 [m]</translation>
        </message>
        <message>
            <source>Predicted sigma up [m]</source>
            <translation>预测高程 σ [m]</translation>
        </message>
        <message>
            <source>Up in sigmas</source>
            <translation>高程差与 σ 之比</translation>
        </message>
        <message>
            <source>Slope [%]</source>
            <translation>坡度 [%]</translation>
        </message>
        <message>
            <source>Cover</source>
            <translation>地表</translation>
        </message>
        <message>
            <source>Counted</source>
            <translation>计入</translation>
        </message>
        <message>
            <source>No mark was compared with the product in a way that counts, so there are no figures.</source>
            <translation>没有标志点以可计入的方式与成果比较，因此没有数值。</translation>
        </message>
        <message>
            <source>All in metres; product less mark. SD divides by n − 1. NMAD is 1.4826 times the median distance from the median: what the SD would be without outliers. |d| is the size of a difference. Intervals come from redrawing the marks.</source>
            <translation>单位均为米；成果减标志点。标准差以 n − 1 为除数。NMAD 为与中位数之差绝对值的中位数的 1.4826 倍，即没有粗差时的标准差。|d| 为差值的绝对值。区间由对标志点重抽样得到。</translation>
        </message>
        <message>
            <source>Check marks: used for nothing but these figures</source>
            <translation>检核点：只用于这些数值</translation>
        </message>
        <message>
            <source>No check mark was compared.</source>
            <translation>没有检核点参与比较。</translation>
        </message>
        <message>
            <source>Control marks: open to alignment and tuning, so they prove less</source>
            <translation>控制点：可能用于对准和调参，因此说服力较弱</translation>
        </message>
        <message>
            <source>All comparisons, mark by mark: %1</source>
            <translation>逐点列出全部比较：%1</translation>
        </message>
        <message>
            <source>Adjustment of all runs</source>
            <translation>全部测线整体平差</translation>
        </message>
        <message>
            <source>Unknowns</source>
            <translation>未知数</translation>
        </message>
        <message>
            <source>Crossovers</source>
            <translation>交叉点</translation>
        </message>
        <message>
            <source>%1 pairs of passes over the same ground</source>
            <translation>%1 对重复经过同一地面的交叉</translation>
        </message>
        <message>
            <source>Their heights differ by</source>
            <translation>交叉点高程互差</translation>
        </message>
        <message>
            <source>%1 m RMS after the filter, %2 m after the adjustment</source>
            <translation>滤波后 %1 m（RMS），平差后 %2 m</translation>
        </message>
        <message>
            <source>Rounds</source>
            <translation>迭代次数</translation>
        </message>
        <message>
            <source>%1, the last of which moved a track by %2 m RMS</source>
            <translation>%1，最后一次使轨迹移动 %2 m（RMS）</translation>
        </message>
        <message>
            <source>Their test of the sigmas</source>
            <translation>用交叉点检验 σ</translation>
        </message>
        <message>
            <source>%1 of %2 differences lie within 1.96 predicted sigmas, the mean square of difference over sigma is %3; before crossovers were used</source>
            <translation>%2 个互差中 %1 个在预测的 1.96 σ 以内，互差与 σ 之比的均方为 %3；采用交叉点之前</translation>
        </message>
        <message>
            <source>Crossovers left out of the adjustment</source>
            <translation>未参与平差的交叉点</translation>
        </message>
        <message>
            <source>%1; their heights differ by %2 m RMS after the filter, %3 m after the adjustment</source>
            <translation>%1 个；高程互差滤波后 %2 m（RMS），平差后 %3 m</translation>
        </message>
        <message>
            <source>Variance of heights</source>
            <translation>高程方差</translation>
        </message>
        <message>
            <source>kept: no crossovers to test it</source>
            <translation>保持不变：没有可检验的交叉点</translation>
        </message>
        <message>
            <source>multiplied by %1, see the crossovers' test</source>
            <translation>乘以 %1，见交叉点检验</translation>
        </message>
        <message>
            <source>Variance of the plan</source>
            <translation>平面方差</translation>
        </message>
        <message>
            <source>kept: GNSS drifts as its noise says</source>
            <translation>保持不变：GNSS 漂移与其噪声相符</translation>
        </message>
        <message>
            <source>multiplied by %1: GNSS drifts by more than its robust noise says</source>
            <translation>乘以 %1：GNSS 漂移大于其稳健噪声</translation>
        </message>
        <message>
            <source>Source of noise</source>
            <translation>噪声来源</translation>
        </message>
        <message>
            <source>Rows</source>
            <translation>方程数</translation>
        </message>
        <message>
            <source>Sigma times</source>
            <translation>σ 倍数</translation>
        </message>
        <message>
            <source>Down-weighted</source>
            <translation>降权</translation>
        </message>
        <message>
            <source>Sigma times: by what factor the survey's own residuals say that a sigma of the settings is off. 1 where it was not estimated.</source>
            <translation>σ 倍数：由本次测量自身残差得出的、设置中 σ 应乘的倍数。未估计时为 1。</translation>
        </message>
        <message>
            <source>prior</source>
            <translation>先验</translation>
        </message>
        <message>
            <source>mark ties</source>
            <translation>标志点约束</translation>
        </message>
        <message>
            <source>plan</source>
            <translation>平面</translation>
        </message>
        <message>
            <source>height</source>
            <translation>高程</translation>
        </message>
        <message>
            <source>GNSS noise</source>
            <translation>GNSS 噪声</translation>
        </message>
        <message>
            <source>GNSS drift</source>
            <translation>GNSS 漂移</translation>
        </message>
        <message>
            <source>GNSS bias of a run</source>
            <translation>每条测线的 GNSS 偏差</translation>
        </message>
        <message>
            <source>barometer noise</source>
            <translation>气压计噪声</translation>
        </message>
        <message>
            <source>barometer drift</source>
            <translation>气压计漂移</translation>
        </message>
        <message>
            <source>barometer gusts</source>
            <translation>阵风对气压计的影响</translation>
        </message>
        <message>
            <source>optical flow bridged</source>
            <translation>光流补缺</translation>
        </message>
        <message>
            <source>compass drift</source>
            <translation>罗盘漂移</translation>
        </message>
        <message>
            <source>compass noise</source>
            <translation>罗盘噪声</translation>
        </message>
        <message>
            <source>gyro</source>
            <translation>陀螺仪</translation>
        </message>
        <message>
            <source>walk</source>
            <translation>行走</translation>
        </message>
        <message>
            <source>ground climb</source>
            <translation>地面起伏</translation>
        </message>
        <message>
            <source>ground roughness</source>
            <translation>地面粗糙度</translation>
        </message>
        <message>
            <source>climb</source>
            <translation>起伏</translation>
        </message>
        <message>
            <source>accelerometer bias</source>
            <translation>加速度计零偏</translation>
        </message>
        <message>
            <source>crossovers</source>
            <translation>交叉点</translation>
        </message>
        <message>
            <source>passes over marks</source>
            <translation>经过标志点</translation>
        </message>
        <message>
            <source>heading</source>
            <translation>航向</translation>
        </message>
        <message>
            <source>%1, %2 m in all, median step %3 m, place known to %4 m (1 sigma)</source>
            <translation>%1 条，共 %2 m，落差中位数 %3 m，位置精度 %4 m（1 σ）</translation>
        </message>
        <message>
            <source>Method</source>
            <translation>方法</translation>
        </message>
        <message>
            <source>Method asked for, and used</source>
            <translation>要求的方法和采用的方法</translation>
        </message>
        <message>
            <source>Breaklines</source>
            <translation>断裂线</translation>
        </message>
        <message>
            <source>Terrace edges found</source>
            <translation>找到的梯田边缘</translation>
        </message>
        <message>
            <source>Note</source>
            <translation>说明</translation>
        </message>
        <message>
            <source>Ground points</source>
            <translation>地面点</translation>
        </message>
        <message>
            <source>Triangles</source>
            <translation>三角形</translation>
        </message>
        <message>
            <source>%1, no edge longer than %2 m in plan</source>
            <translation>%1 个，平面边长不超过 %2 m</translation>
        </message>
        <message>
            <source>Area in plan</source>
            <translation>平面面积</translation>
        </message>
        <message>
            <source>Grid</source>
            <translation>格网</translation>
        </message>
        <message>
            <source>%1 × %2 cells of %3 m</source>
            <translation>%1 × %2 格，格网间距 %3 m</translation>
        </message>
        <message>
            <source>Cells with a height</source>
            <translation>有高程的格网</translation>
        </message>
        <message>
            <source>%1 (%2); the others are left empty, nothing is invented outside the walk</source>
            <translation>%1（%2）；其余留空，行走范围之外不作臆造</translation>
        </message>
        <message>
            <source>Standard error of a height</source>
            <translation>高程的标准差</translation>
        </message>
        <message>
            <source>%1 m in the middle, below %2 m in 95 % of the cells</source>
            <translation>中位数 %1 m，95 % 的格网小于 %2 m</translation>
        </message>
        <message>
            <source>Cells</source>
            <translation>格网来源</translation>
        </message>
        <message>
            <source>%1 measured, %2 interpolated, %3 extrapolated (farther than %4 m from a point)</source>
            <translation>实测 %1，内插 %2，外推 %3（距点超过 %4 m）</translation>
        </message>
        <message>
            <source>Interpolation</source>
            <translation>插值</translation>
        </message>
        <message>
            <source>%1 heights foretold from the points around them, %2 within 1.96 sigma</source>
            <translation>由周围点预测 %1 个高程，%2 在 1.96 σ 以内</translation>
        </message>
        <message>
            <source>the method’s own variance, scaled</source>
            <translation>方法自身的方差，经缩放</translation>
        </message>
        <message>
            <source>Variogram</source>
            <translation>变异函数</translation>
        </message>
        <message>
            <source>%1, nugget %2, sill %3 at %4, from %5 pairs of points</source>
            <translation>%1，块金 %2，基台 %3，变程 %4，由 %5 对点求得</translation>
        </message>
        <message>
            <source>spherical</source>
            <translation>球状模型</translation>
        </message>
        <message>
            <source>exponential</source>
            <translation>指数模型</translation>
        </message>
        <message>
            <source>power %1</source>
            <translation>幂模型 %1</translation>
        </message>
        <message>
            <source>Heights</source>
            <translation>高程</translation>
        </message>
        <message>
            <source>%1 m to %2 m</source>
            <translation>%1 m 至 %2 m</translation>
        </message>
        <message>
            <source>Map frame</source>
            <translation>地图坐标系</translation>
        </message>
        <message>
            <source>Terrawalk local frame, zero point %1</source>
            <translation>Terrawalk 局部坐标系，零点 %1</translation>
        </message>
        <message>
            <source>Heights refer to</source>
            <translation>高程基准</translation>
        </message>
        <message>
            <source>Ways of interpolating, the best first, by how well points that were left out are foretold from the others (seed %1). Breaklines and edges take no part.</source>
            <translation>插值方法，按由其余点预测留出点的优劣排列，最优在前（随机种子 %1）。断裂线和边缘不参与。</translation>
        </message>
        <message>
            <source>What the laser crossed is free, where it ended is occupied; of the rest nothing is known. Files: occupancy.bt and occupancy.ot for OctoMap, free_height.tif, and obstacle_height.tif where there is any obstacle.</source>
            <translation>激光穿过之处为空闲，终止之处为占用；其余未知。文件：OctoMap 用的 occupancy.bt 和 occupancy.ot，free_height.tif，有障碍物时还有 obstacle_height.tif。</translation>
        </message>
        <message>
            <source>Ground layer</source>
            <translation>地面层</translation>
        </message>
        <message>
            <source>what lies lower than %1 m above the terrain model counts as ground; looked up to %2 m</source>
            <translation>地形模型以上 %1 m 以内算作地面；向上查看至 %2 m</translation>
        </message>
        <message>
            <source>%1 and %2 more</source>
            <translation>%1 等，另有 %2 行</translation>
        </message>
        <message>
            <source>Fix</source>
            <translation>定位解</translation>
        </message>
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
            <translation>差分解</translation>
        </message>
        <message>
            <source>single</source>
            <translation>单点解</translation>
        </message>
        <message>
            <source>code %1</source>
            <translation>代码 %1</translation>
        </message>
        <message>
            <source>no code</source>
            <translation>无代码</translation>
        </message>
        <message>
            <source>area</source>
            <translation>区域</translation>
        </message>
        <message>
            <source>fixed-point</source>
            <translation>定点</translation>
        </message>
        <message>
            <source>Kind</source>
            <translation>类型</translation>
        </message>
        <message>
            <source>Rows read</source>
            <translation>读取行数</translation>
        </message>
        <message>
            <source>Repeated</source>
            <translation>重复</translation>
        </message>
        <message>
            <source>Late</source>
            <translation>乱序</translation>
        </message>
        <message>
            <source>Epochs</source>
            <translation>历元</translation>
        </message>
        <message>
            <source>Duration [s]</source>
            <translation>时长 [s]</translation>
        </message>
        <message>
            <source>Longest gap [s]</source>
            <translation>最长间断 [s]</translation>
        </message>
        <message>
            <source>Distance [m]</source>
            <translation>距离 [m]</translation>
        </message>
        <message>
            <source>rows with a repeated time dropped, lines %1.</source>
            <translation>时间重复的行已舍去，行号 %1。</translation>
        </message>
        <message>
            <source>late rows put in order, lines %1.</source>
            <translation>乱序的行已排序，行号 %1。</translation>
        </message>
        <message>
            <source>the last row, line %1, is cut off and was dropped.</source>
            <translation>最后一行（第 %1 行）不完整，已舍去。</translation>
        </message>
        <message>
            <source>The survey has no runs.</source>
            <translation>本次测量没有测线。</translation>
        </message>
        <message>
            <source>Logs</source>
            <translation>记录文件</translation>
        </message>
        <message>
            <source>What the reader and the estimator met, run by run</source>
            <translation>读取和估计时遇到的情况，逐条测线</translation>
        </message>
        <message>
            <source>Used points make the surface; the others are kept with their reason.</source>
            <translation>采用的点构成曲面；其余的点连同原因保留。</translation>
        </message>
        <message>
            <source>Use of the sensors</source>
            <translation>传感器的使用</translation>
        </message>
        <message>
            <source>No sensor was offered to an estimator.</source>
            <translation>没有向估计器提供传感器数据。</translation>
        </message>
        <message>
            <source>Sensor</source>
            <translation>传感器</translation>
        </message>
        <message>
            <source>Offered</source>
            <translation>提供</translation>
        </message>
        <message>
            <source>Used share</source>
            <translation>采用率</translation>
        </message>
        <message>
            <source>Of these down-weighted</source>
            <translation>其中降权</translation>
        </message>
        <message>
            <source>Rejected</source>
            <translation>拒绝</translation>
        </message>
        <message>
            <source>Reasons</source>
            <translation>原因</translation>
        </message>
        <message>
            <source>Measurements of all runs together: offered = used + rejected.</source>
            <translation>全部测线的观测合计：提供 = 采用 + 拒绝。</translation>
        </message>
        <message>
            <source>Run by run</source>
            <translation>逐条测线</translation>
        </message>
        <message>
            <source>beyond gate</source>
            <translation>超出门限</translation>
        </message>
        <message>
            <source>beyond the greatest noise</source>
            <translation>超出最大噪声</translation>
        </message>
        <message>
            <source>no attitude</source>
            <translation>没有姿态</translation>
        </message>
        <message>
            <source>one component missing</source>
            <translation>缺一个分量</translation>
        </message>
        <message>
            <source>too slow</source>
            <translation>速度太慢</translation>
        </message>
        <message>
            <source>Tuning</source>
            <translation>调参</translation>
        </message>
        <message>
            <source>Tuned values</source>
            <translation>调参结果</translation>
        </message>
        <message>
            <source>used for this product</source>
            <translation>已用于本成果</translation>
        </message>
        <message>
            <source>not used</source>
            <translation>未采用</translation>
        </message>
        <message>
            <source>Tuned on the survey</source>
            <translation>调参所用测量</translation>
        </message>
        <message>
            <source>By</source>
            <translation>程序</translation>
        </message>
        <message>
            <source>Search</source>
            <translation>搜索</translation>
        </message>
        <message>
            <source>%1, population %2, %3 iterations, seed %4</source>
            <translation>%1，种群 %2，迭代 %3 次，随机种子 %4</translation>
        </message>
        <message>
            <source>Evaluations, in all</source>
            <translation>评估总次数</translation>
        </message>
        <message>
            <source>Loss</source>
            <translation>损失</translation>
        </message>
        <message>
            <source>Loss before and after</source>
            <translation>前后损失</translation>
        </message>
        <message>
            <source>The same on parts left out of the tuning</source>
            <translation>在未参与调参的部分上</translation>
        </message>
        <message>
            <source>Marks tuned on</source>
            <translation>调参所用标志点</translation>
        </message>
        <message>
            <source>Setting</source>
            <translation>设置项</translation>
        </message>
        <message>
            <source>Requested</source>
            <translation>要求值</translation>
        </message>
        <message>
            <source>File</source>
            <translation>文件</translation>
        </message>
        <message>
            <source>Bytes</source>
            <translation>字节</translation>
        </message>
        <message>
            <source>Program</source>
            <translation>程序</translation>
        </message>
        <message>
            <source>Method of fusion</source>
            <translation>融合方法</translation>
        </message>
        <message>
            <source>Seed of random numbers</source>
            <translation>随机种子</translation>
        </message>
        <message>
            <source>Settings: %1 in all, %2 other than default</source>
            <translation>设置：共 %1 项，%2 项与默认值不同</translation>
        </message>
        <message>
            <source>Input files: %1</source>
            <translation>输入文件：%1</translation>
        </message>
        <message>
            <source>Made by Terrawalk from the files listed above. The same figures stand in report.json, the comparisons in residuals.csv.</source>
            <translation>由 Terrawalk 根据上列文件生成。同样的数值见 report.json，各项比较见 residuals.csv。</translation>
        </message>
        <message>
            <source>raw sensors, no fusion</source>
            <translation>传感器原始数据，不融合</translation>
        </message>
        <message>
            <source>9-state unscented Kalman filter</source>
            <translation>9 状态无迹卡尔曼滤波</translation>
        </message>
        <message>
            <source>9-state unscented Kalman filter, Rauch-Tung-Striebel smoothed</source>
            <translation>9 状态无迹卡尔曼滤波，Rauch-Tung-Striebel 平滑</translation>
        </message>
        <message>
            <source>9-state %1 as published (Xie et al. 2024), forward only</source>
            <translation>9 状态 %1，按发表的方法（Xie et al. 2024），仅前向</translation>
        </message>
        <message>
            <source>adaptive unscented Kalman filter with error states, then joint adjustment of all runs with their crossovers</source>
            <translation>带误差状态的自适应无迹卡尔曼滤波，再对全部测线连同交叉点整体平差</translation>
        </message>
        <message>
            <source>adaptive unscented Kalman filter with error states, then crossovers in a second stage (a preview)</source>
            <translation>带误差状态的自适应无迹卡尔曼滤波，第二阶段采用交叉点（预览）</translation>
        </message>
        <message>
            <source>Delaunay triangulation, linear interpolation at cell centres</source>
            <translation>Delaunay 三角剖分，格网中心线性插值</translation>
        </message>
        <message>
            <source>constrained Delaunay triangulation, linear interpolation at cell centres</source>
            <translation>约束 Delaunay 三角剖分，格网中心线性插值</translation>
        </message>
        <message>
            <source>%1 at cell centres, within the Delaunay triangulation</source>
            <translation>格网中心 %1 插值，限于 Delaunay 三角网内</translation>
        </message>
        <message>
            <source>%1 at cell centres, within the constrained Delaunay triangulation</source>
            <translation>格网中心 %1 插值，限于约束 Delaunay 三角网内</translation>
        </message>
        <message>
            <source>Map of tracks and marks</source>
            <translation>轨迹和标志点地图</translation>
        </message>
        <message>
            <source>Height error at each mark</source>
            <translation>各标志点处的高程误差</translation>
        </message>
        <message>
            <source>Height error below the array at each stand on a mark</source>
            <translation>每次在标志点上静站时阵列下方的高程误差</translation>
        </message>
        <message>
            <source>Error in plan at each stand on a mark</source>
            <translation>每次在标志点上静站时的平面误差</translation>
        </message>
        <message>
            <source>Histogram of height errors</source>
            <translation>高程误差直方图</translation>
        </message>
        <message>
            <source>%1 m, height of the surface</source>
            <translation>%1 m，曲面高程</translation>
        </message>
        <message>
            <source>east of the zero point [m]</source>
            <translation>零点以东 [m]</translation>
        </message>
        <message>
            <source>north of the zero point [m]</source>
            <translation>零点以北 [m]</translation>
        </message>
        <message>
            <source>check mark</source>
            <translation>检核点</translation>
        </message>
        <message>
            <source>control mark</source>
            <translation>控制点</translation>
        </message>
        <message>
            <source>%1 m too high, too low</source>
            <translation>偏高、偏低 %1 m</translation>
        </message>
        <message>
            <source>%1 m too high, too low (longest cut)</source>
            <translation>偏高、偏低 %1 m（最长者截断）</translation>
        </message>
        <message>
            <source>1 name left out for room</source>
            <translation>1 个点名因空间不足未注</translation>
        </message>
        <message>
            <source>%1 names left out for room</source>
            <translation>%1 个点名因空间不足未注</translation>
        </message>
        <message>
            <source>product − mark [m]</source>
            <translation>成果 − 标志点 [m]</translation>
        </message>
        <message>
            <source>control marks</source>
            <translation>控制点</translation>
        </message>
        <message>
            <source>control marks →</source>
            <translation>控制点 →</translation>
        </message>
        <message>
            <source>%1 beyond the frame △</source>
            <translation>%1 个超出图框 △</translation>
        </message>
        <message>
            <source>%1 beyond the last ring, drawn at the rim</source>
            <translation>%1 个超出最外圈，画在边缘</translation>
        </message>
        <message>
            <source>%1, %2: %3 east, %4 north</source>
            <translation>%1，%2：东 %3，北 %4</translation>
        </message>
        <message>
            <source>%1 to %2 m: %3</source>
            <translation>%1 至 %2 m：%3</translation>
        </message>
        <message>
            <source>%1 heights at %2 marks</source>
            <translation>%2点处 %1 个高程</translation>
        </message>
        <message>
            <source>%1 heights at %2 marks; normal curve of the same mean and SD</source>
            <translation>%2点处 %1 个高程；平均值和标准差相同的正态曲线</translation>
        </message>
        <message>
            <source>GNSS stands off by up to %1 m from the positions around it, %2 times, for %3 s in all: wrong fixes or reflected signals, which count by the size of their jump</source>
            <translation>GNSS 与前后位置相差最大 %1 m，共 %2 次，合计 %3 s：错误的定位解或反射信号，按跳变大小降权</translation>
        </message>
        <message>
            <source>Heights are metres above the plane through the zero point (%1) that is level there; they are not reduced to a geoid.</source>
            <translation>高程为零点（%1）处水平面以上的米数；未归算到大地水准面。</translation>
        </message>
        <message>
            <source>Heights are metres above the WGS 84 ellipsoid.</source>
            <translation>高程为 WGS 84 椭球面以上的米数。</translation>
        </message>
        <message>
            <source>%1 more marks are off as far; the table of differences names them.</source>
            <translation>另有 %1 个标志点偏差同样大；见差值表。</translation>
        </message>
        <message>
            <source>no texture</source>
            <translation>没有纹理</translation>
        </message>
        <message>
            <source>no fix</source>
            <translation>没有定位解</translation>
        </message>
        <message>
            <source>no RTK fix</source>
            <translation>没有 RTK 解</translation>
        </message>
        <message>
            <source>fix code that names no satellite fix</source>
            <translation>定位代码不表示卫星解</translation>
        </message>
        <message>
            <source>no roll</source>
            <translation>没有横滚角</translation>
        </message>
        <message>
            <source>no pitch</source>
            <translation>没有俯仰角</translation>
        </message>
        <message>
            <source>no heading</source>
            <translation>没有航向</translation>
        </message>
        <message>
            <source>the array is taken to be level</source>
            <translation>假定阵列水平</translation>
        </message>
        <message>
            <source>optical flow and horizontal acceleration cannot be used</source>
            <translation>不能使用光流和水平加速度</translation>
        </message>
        <message>
            <source>roll</source>
            <translation>横滚角</translation>
        </message>
        <message>
            <source>pitch</source>
            <translation>俯仰角</translation>
        </message>
        <message>
            <source>%1 of its fields are no numbers</source>
            <translation>其中 %1 个字段不是数字</translation>
        </message>
        <message>
            <source>%1 reads the same log as %2</source>
            <translation>%1 与 %2 读取同一份记录</translation>
        </message>
        <message>
            <source>%1 (run %2)</source>
            <translation>%1（测线 %2）</translation>
        </message>
        <message>
            <source>Run %1 starts on check mark %2, which the estimator may not use: it begins as if nothing were known.</source>
            <translation>测线 %1 从检核点 %2 开始，估计器不能使用该点：按一无所知开始。</translation>
        </message>
        <message>
            <source>passes side by side</source>
            <translation>并排经过</translation>
        </message>
        <message>
            <source>no header with three columns or more</source>
            <translation>没有三列以上的标题行</translation>
        </message>
        <message>
            <source>the first column holds no name</source>
            <translation>第一列不是名称</translation>
        </message>
        <message>
            <source>the row has another number of fields than the header</source>
            <translation>该行的字段数与标题行不同</translation>
        </message>
        <message>
            <source>process the survey again with this version</source>
            <translation>请用本版本重新处理测量</translation>
        </message>
        <message>
            <source>process the survey again</source>
            <translation>请重新处理测量</translation>
        </message>
        <message>
            <source>the manifest does not tell the frame of the survey</source>
            <translation>清单中没有测量的坐标系</translation>
        </message>
        <message>
            <source>this is no manifest of a processed survey</source>
            <translation>这不是已处理测量的清单</translation>
        </message>
        <message>
            <source>take another optimiser</source>
            <translation>请换一种优化算法</translation>
        </message>
        <message>
            <source>GeoTIFF cannot hold this CRS</source>
            <translation>GeoTIFF 不能保存该坐标参考系</translation>
        </message>
        <message>
            <source>another size</source>
            <translation>大小不同</translation>
        </message>
        <message>
            <source>another place</source>
            <translation>位置不同</translation>
        </message>
        <message>
            <source>another nodata value</source>
            <translation>无数据值不同</translation>
        </message>
        <message>
            <source>other heights</source>
            <translation>高程不同</translation>
        </message>
        <message>
            <source>no raster</source>
            <translation>没有栅格</translation>
        </message>
        <message>
            <source>no reason named</source>
            <translation>没有说明原因</translation>
        </message>
        <message>
            <source>a ground point has no place</source>
            <translation>有一个地面点没有位置</translation>
        </message>
        <message>
            <source>not all lines can be read again</source>
            <translation>不是所有的线都能读回</translation>
        </message>
        <message>
            <source>GDAL does not understand the CRS</source>
            <translation>GDAL 不理解该坐标参考系</translation>
        </message>
        <message>
            <source>no transaction</source>
            <translation>无法开始事务</translation>
        </message>
        <message>
            <source>cannot carry a file over to the new output</source>
            <translation>无法把文件移入新的输出</translation>
        </message>
        <message>
            <source>cannot look at the folder</source>
            <translation>无法查看该文件夹</translation>
        </message>
        <message>
            <source>cannot remove the remains of a previous output</source>
            <translation>无法删除先前输出的残留</translation>
        </message>
        <message>
            <source>cannot set the permissions of the output</source>
            <translation>无法设置输出的权限</translation>
        </message>
        <message>
            <source>the new output is in place, but the previous one cannot be renamed</source>
            <translation>新的输出已就位，但先前的输出无法改名</translation>
        </message>
        <message>
            <source>cannot read the previous output</source>
            <translation>无法读取先前的输出</translation>
        </message>
        <message>
            <source>a point that is used has no place</source>
            <translation>有一个采用的点没有位置</translation>
        </message>
        <message>
            <source>it must be a table that terrawalk wrote</source>
            <translation>必须是 terrawalk 写出的表</translation>
        </message>
        <message>
            <source>it must be a trajectory that terrawalk wrote</source>
            <translation>必须是 terrawalk 写出的轨迹</translation>
        </message>
        <message>
            <source>no rows</source>
            <translation>没有行</translation>
        </message>
        <message>
            <source>the time does not grow</source>
            <translation>时间没有递增</translation>
        </message>
        <message>
            <source>heights are neither in metres nor in feet</source>
            <translation>高程的单位既不是米也不是英尺</translation>
        </message>
        <message>
            <source>convert one of them</source>
            <translation>请换算其中之一</translation>
        </message>
        <message>
            <source>convert them</source>
            <translation>请换算</translation>
        </message>
        <message>
            <source>project the points first</source>
            <translation>请先把点投影</translation>
        </message>
        <message>
            <source>cannot write a log without rows</source>
            <translation>不能写出没有行的日志</translation>
        </message>
        <message>
            <source>the wanted cells are those of another grid</source>
            <translation>所需格网属于另一个格网</translation>
        </message>
        <message>
            <source>no such method of interpolation</source>
            <translation>没有这种插值方法</translation>
        </message>
        <message>
            <source>'%1' is no setting</source>
            <translation>“%1”不是设置项</translation>
        </message>
        <message>
            <source>pagmo refuses the search: %1</source>
            <translation>pagmo 拒绝搜索：%1</translation>
        </message>
        <message>
            <source>%1 names no class</source>
            <translation>%1 不表示类别</translation>
        </message>
        <message>
            <source>the DEM holds %1 heights for %2 x %3 cells</source>
            <translation>DEM 有 %1 个高程，格网却为 %2 x %3</translation>
        </message>
        <message>
            <source>cannot remove a side file of the earlier DEM: %1</source>
            <translation>无法删除先前 DEM 的附属文件：%1</translation>
        </message>
        <message>
            <source>a ground point names run %1 of %2</source>
            <translation>有一个地面点属于第 %1 条测线，而共有 %2 条</translation>
        </message>
        <message>
            <source>used %1 with reason %2</source>
            <translation>采用标记为 %1，原因却为 %2</translation>
        </message>
        <message>
            <source>%1 holds a control character</source>
            <translation>%1 含有控制字符</translation>
        </message>
        <message>
            <source>%1 is an absolute path</source>
            <translation>%1 是绝对路径</translation>
        </message>
        <message>
            <source>%1 leaves the project's folder</source>
            <translation>%1 超出了项目文件夹</translation>
        </message>
        <message>
            <source>%1 leads out of the project's folder by a link</source>
            <translation>%1 经链接指向项目文件夹之外</translation>
        </message>
        <message>
            <source>%1 is neither in metres nor in feet</source>
            <translation>%1 的单位既不是米也不是英尺</translation>
        </message>
        <message>
            <source>%1 is no plane CRS: a surface needs east and north in metres or feet</source>
            <translation>%1 不是平面坐标参考系：曲面需要以米或英尺计的东、北坐标</translation>
        </message>
        <message>
            <source>the plan is in %1 and heights are in %2</source>
            <translation>平面单位为 %1，高程单位为 %2</translation>
        </message>
        <message>
            <source>cannot write run "%1": its id names no file of its own</source>
            <translation>无法写出测线 "%1"：其名称不能作为独立的文件名</translation>
        </message>
        <message>
            <source>%1 sigmas were given for %2 points</source>
            <translation>给了 %1 个 σ，却有 %2 个点</translation>
        </message>
        <message>
            <source>The check marks' own error is not known: the RMSE_V found leaves it out.</source>
            <translation>检查点自身误差未知：所得 RMSE_V 未计入它。</translation>
        </message>
        <message>
            <source>no run stood on a mark that it was not tied to, so nothing tells its error in plan</source>
            <translation>没有测线停在未用于约束它的标志点上，平面误差无从得知</translation>
        </message>
        <message>
            <source>the surface has no slope at the marks</source>
            <translation>标志点处地表没有坡度</translation>
        </message>
        <message>
            <source>the heights have no error</source>
            <translation>高程没有误差</translation>
        </message>
        <message>
            <source>This data set was tested to meet ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 2, Version 2 (2024) for a %1 cm RMSE_V Vertical Accuracy Class. The Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = %2 cm.</source>
            <translation>经检验，本数据集达到ASPRS《数字地理空间数据定位精度标准》第 2 版第 2 次修订（2024）的 %1 cm RMSE_V 高程精度等级。非植被区高程精度（NVA）为 RMSE_V = %2 cm。</translation>
        </message>
        <message>
            <source>This data set was tested as required by ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 2, Version 2 (2024) and does not meet the %1 cm RMSE_V Vertical Accuracy Class asked for. The Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = %2 cm.</source>
            <translation>本数据集按ASPRS《数字地理空间数据定位精度标准》第 2 版第 2 次修订（2024）的要求检验，未达到所要求的 %1 cm RMSE_V 高程精度等级。非植被区高程精度（NVA）为 RMSE_V = %2 cm。</translation>
        </message>
        <message>
            <source>This data set was not tested as required by ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 2, Version 2 (2024): the check marks' own error of %1 cm is more than half of the %2 cm RMSE_V Vertical Accuracy Class asked for. The Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = %3 cm.</source>
            <translation>本数据集未能按ASPRS《数字地理空间数据定位精度标准》第 2 版第 2 次修订（2024）的要求检验：检查点自身误差 %1 cm 大于所要求的 %2 cm RMSE_V 高程精度等级的一半。非植被区高程精度（NVA）为 RMSE_V = %3 cm。</translation>
        </message>
        <message>
            <source>This data set was tested as required by ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 2, Version 2 (2024). Although the Standards call for a minimum of thirty (30) checkpoints, this test was performed using ONLY %1 checkpoints. The Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = %2 cm using the reduced number of checkpoints, within the %3 cm RMSE_V Vertical Accuracy Class asked for.</source>
            <translation>本数据集按ASPRS《数字地理空间数据定位精度标准》第 2 版第 2 次修订（2024）的要求检验。标准要求至少三十（30）个检查点，本次检验仅用了 %1 个。用减少的检查点得到的非植被区高程精度（NVA）为 RMSE_V = %2 cm，在所要求的 %3 cm RMSE_V 高程精度等级之内。</translation>
        </message>
        <message>
            <source>This data set was tested as required by ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 2, Version 2 (2024). Although the Standards call for a minimum of thirty (30) checkpoints, this test was performed using ONLY %1 checkpoints. The Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = %2 cm using the reduced number of checkpoints, beyond the %3 cm RMSE_V Vertical Accuracy Class asked for.</source>
            <translation>本数据集按ASPRS《数字地理空间数据定位精度标准》第 2 版第 2 次修订（2024）的要求检验。标准要求至少三十（30）个检查点，本次检验仅用了 %1 个。用减少的检查点得到的非植被区高程精度（NVA）为 RMSE_V = %2 cm，超出所要求的 %3 cm RMSE_V 高程精度等级。</translation>
        </message>
        <message>
            <source>The Vegetated Vertical Accuracy (VVA) was found to be RMSE_V = %1 cm at %2.</source>
            <translation>植被区高程精度（VVA）在%2处为 RMSE_V = %1 cm。</translation>
        </message>
        <message>
            <source>The mean error of %1 is more than a quarter of the RMSE_V asked for: the ASPRS standards want its cause found.</source>
            <translation>平均误差 %1 超过所要求 RMSE_V 的四分之一：ASPRS 标准要求查明原因。</translation>
        </message>
        <message>
            <source>%1 is off by %2, more than %3 times the RMSE_V asked for: a possible blunder. It is counted.</source>
            <translation>%1 偏差 %2，超过所要求 RMSE_V 的 %3 倍：可能是粗差，仍计入统计。</translation>
        </message>
        <message>
            <source>What errors in plan add to errors of height on slopes is not known: %1.</source>
            <translation>平面误差在坡地上给高程误差带来多少尚不清楚：%1。</translation>
        </message>
        <message>
            <source>breaklines</source>
            <translation>断裂线</translation>
        </message>
        <message>
            <source>the %1 have x %2 to %3 and y %4 to %5, which could be degrees, but %6</source>
            <translation>%1的坐标 x 为 %2 至 %3，y 为 %4 至 %5，可能是度，但是%6</translation>
        </message>
        <message>
            <source>the %1 have x %2 to %3 and y %4 to %5, which are no degrees, but %6</source>
            <translation>%1的坐标 x 为 %2 至 %3，y 为 %4 至 %5，不是度，但是%6</translation>
        </message>
        <message>
            <source>GeoJSON that names no CRS counts as WGS 84: where its coordinates are those of a plane, name their CRS, e.g. with `ogr2ogr -a_srs EPSG:32649 new.gpkg old.geojson`; project degrees with `-t_srs`</source>
            <translation>未注明坐标系的 GeoJSON 按 WGS 84 处理：若其坐标是平面坐标，请注明坐标系，例如用 `ogr2ogr -a_srs EPSG:32649 new.gpkg old.geojson`；若是度，用 `-t_srs` 投影</translation>
        </message>
        <message>
            <source>project them first, e.g. with `ogr2ogr -t_srs`; where only the CRS is named wrong, `-a_srs` names another</source>
            <translation>先投影，例如用 `ogr2ogr -t_srs`；若只是坐标系注错，用 `-a_srs` 另行注明</translation>
        </message>
        <message>
            <source>the adjustment of all runs has not settled: the last of %1 rounds moved a track by %2 m</source>
            <translation>整体平差未收敛：共 %1 轮，最后一轮仍使一条轨迹移动 %2 m</translation>
        </message>
        <message>
            <source>optical flow scale</source>
            <translation>光流比例</translation>
        </message>
        <message>
            <source>the scale of the optical flow wanders: the adjustment follows it</source>
            <translation>光流比例在缓慢变化：整体平差已随之估计</translation>
        </message>
        <message>
            <source>adjusting all runs anew: the scale of the optical flow wanders</source>
            <translation>重新整体平差：光流比例在缓慢变化</translation>
        </message>
        <message>
            <source>the point e %1 n %2 u %3 m of the local frame cannot be taken to %4</source>
            <translation>局部坐标系的点 e %1 n %2 u %3 m 无法转换到 %4</translation>
        </message>
        <message>
            <source>all readings</source>
            <translation>所有读数</translation>
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
            <source>Drawn by hand: a line of the surface.</source>
            <translation>手工绘制：1 条线。</translation>
        </message>
        <message>
            <source>Left out by hand: %1 of run %2 from %3 to %4 s.</source>
            <translation>手动排除：测线 %2 从 %3 至 %4 s 的%1。</translation>
        </message>
        <message>
            <source>Left out by hand: run %1.</source>
            <translation>手动排除：测线 %1。</translation>
        </message>
        <message>
            <source>Left out by hand: mark %1.</source>
            <translation>手动排除：标志点 %1。</translation>
        </message>
        <message>
            <source>Drawn by hand: %1 lines of the surface.</source>
            <translation>手工绘制：%1 条线。</translation>
        </message>
        <message>
            <source>tuning without %1</source>
            <translation>不用 %1 调参</translation>
        </message>
        <message>
            <source>%1 islands for %2 evaluations</source>
            <translation>%1 个岛，%2 次评估</translation>
        </message>
        <message>
            <source>take at most %1 islands</source>
            <translation>请至多取 %1 个岛</translation>
        </message>
        <message>
            <source>runs are named as their logs are</source>
            <translation>测线与其日志同名</translation>
        </message>
        <message>
            <source>drawn line %1</source>
            <translation>绘制线 %1</translation>
        </message>
        <message>
            <source>edge %1 toe</source>
            <translation>边缘 %1 坡脚</translation>
        </message>
        <message>
            <source>edge %1 top</source>
            <translation>边缘 %1 坡顶</translation>
        </message>
    </context>
    <context>
        <name>RunFigure</name>
        <message>
            <source>Height RMSE</source>
            <translation>高程 RMSE</translation>
        </message>
        <message>
            <source>Height, 95 %</source>
            <translation>高程 95 %</translation>
        </message>
        <message>
            <source>Height bias</source>
            <translation>高程偏差</translation>
        </message>
        <message>
            <source>Plan RMSE</source>
            <translation>平面 RMSE</translation>
        </message>
        <message>
            <source>Crossovers</source>
            <translation>交叉点不符</translation>
        </message>
        <message>
            <source>Median σ</source>
            <translation>中位 σ</translation>
        </message>
        <message>
            <source>Area</source>
            <translation>面积</translation>
        </message>
        <message>
            <source>Points</source>
            <translation>点数</translation>
        </message>
        <message>
            <source>Cell size</source>
            <translation>格网</translation>
        </message>
    </context>
    <context>
        <name>Setting</name>
        <message>
            <source>method</source>
            <translation>方法</translation>
        </message>
        <message>
            <source>smooth</source>
            <translation>平滑</translation>
        </message>
        <message>
            <source>stands start</source>
            <translation>起点静站</translation>
        </message>
        <message>
            <source>stands target</source>
            <translation>终点静站</translation>
        </message>
        <message>
            <source>stands tie fixed targets</source>
            <translation>定点测线的终点也作约束</translation>
        </message>
        <message>
            <source>unscented alpha</source>
            <translation>无迹变换 α</translation>
        </message>
        <message>
            <source>unscented beta</source>
            <translation>无迹变换 β</translation>
        </message>
        <message>
            <source>unscented kappa</source>
            <translation>无迹变换 κ</translation>
        </message>
        <message>
            <source>process noise position e</source>
            <translation>过程噪声 东向位置</translation>
        </message>
        <message>
            <source>process noise position n</source>
            <translation>过程噪声 北向位置</translation>
        </message>
        <message>
            <source>process noise position u</source>
            <translation>过程噪声 高程</translation>
        </message>
        <message>
            <source>process noise velocity e</source>
            <translation>过程噪声 东向速度</translation>
        </message>
        <message>
            <source>process noise velocity n</source>
            <translation>过程噪声 北向速度</translation>
        </message>
        <message>
            <source>process noise velocity u</source>
            <translation>过程噪声 垂向速度</translation>
        </message>
        <message>
            <source>process noise acceleration e</source>
            <translation>过程噪声 东向加速度</translation>
        </message>
        <message>
            <source>process noise acceleration n</source>
            <translation>过程噪声 北向加速度</translation>
        </message>
        <message>
            <source>process noise acceleration u</source>
            <translation>过程噪声 垂向加速度</translation>
        </message>
        <message>
            <source>process acceleration time constant</source>
            <translation>加速度时间常数</translation>
        </message>
        <message>
            <source>process longest step</source>
            <translation>最长步长</translation>
        </message>
        <message>
            <source>initial velocity sigma</source>
            <translation>初始速度 σ</translation>
        </message>
        <message>
            <source>initial acceleration sigma</source>
            <translation>初始加速度 σ</translation>
        </message>
        <message>
            <source>initial walking speed</source>
            <translation>初始步行速度</translation>
        </message>
        <message>
            <source>initial position sigma</source>
            <translation>初始位置 σ</translation>
        </message>
        <message>
            <source>initial still speed</source>
            <translation>视为静止的速度</translation>
        </message>
        <message>
            <source>gnss use position</source>
            <translation>使用 GNSS 位置</translation>
        </message>
        <message>
            <source>gnss use velocity</source>
            <translation>使用 GNSS 速度</translation>
        </message>
        <message>
            <source>gnss use height</source>
            <translation>使用 GNSS 高程</translation>
        </message>
        <message>
            <source>gnss sigma single</source>
            <translation>GNSS σ 单点</translation>
        </message>
        <message>
            <source>gnss sigma differential</source>
            <translation>GNSS σ 差分</translation>
        </message>
        <message>
            <source>gnss sigma float</source>
            <translation>GNSS σ 浮点</translation>
        </message>
        <message>
            <source>gnss sigma fixed</source>
            <translation>GNSS σ 固定</translation>
        </message>
        <message>
            <source>gnss sigma single up</source>
            <translation>GNSS 高程 σ 单点</translation>
        </message>
        <message>
            <source>gnss sigma differential up</source>
            <translation>GNSS 高程 σ 差分</translation>
        </message>
        <message>
            <source>gnss sigma float up</source>
            <translation>GNSS 高程 σ 浮点</translation>
        </message>
        <message>
            <source>gnss sigma fixed up</source>
            <translation>GNSS 高程 σ 固定</translation>
        </message>
        <message>
            <source>gnss accuracy floor share</source>
            <translation>GNSS 精度下限比例</translation>
        </message>
        <message>
            <source>gnss correlation</source>
            <translation>GNSS 相关时间</translation>
        </message>
        <message>
            <source>gnss correlation fixed</source>
            <translation>GNSS 相关时间 固定解</translation>
        </message>
        <message>
            <source>gnss velocity sigma</source>
            <translation>GNSS 速度 σ</translation>
        </message>
        <message>
            <source>gnss velocity sigma up</source>
            <translation>GNSS 垂向速度 σ</translation>
        </message>
        <message>
            <source>gnss velocity correlation</source>
            <translation>GNSS 速度相关时间</translation>
        </message>
        <message>
            <source>barometer use</source>
            <translation>使用气压计</translation>
        </message>
        <message>
            <source>barometer scale</source>
            <translation>气压计比例</translation>
        </message>
        <message>
            <source>barometer sigma</source>
            <translation>气压计 σ</translation>
        </message>
        <message>
            <source>barometer gust sigma</source>
            <translation>气压计阵风 σ</translation>
        </message>
        <message>
            <source>barometer gust correlation</source>
            <translation>气压计阵风相关时间</translation>
        </message>
        <message>
            <source>barometer longest silence</source>
            <translation>气压计最长中断</translation>
        </message>
        <message>
            <source>barometer drift</source>
            <translation>气压计漂移</translation>
        </message>
        <message>
            <source>flow use</source>
            <translation>使用光流</translation>
        </message>
        <message>
            <source>flow variance</source>
            <translation>光流方差</translation>
        </message>
        <message>
            <source>flow scale sigma</source>
            <translation>光流比例 σ</translation>
        </message>
        <message>
            <source>flow correlation</source>
            <translation>光流相关时间</translation>
        </message>
        <message>
            <source>flow smallest quality</source>
            <translation>光流最低质量</translation>
        </message>
        <message>
            <source>flow screen</source>
            <translation>光流筛除异常读数</translation>
        </message>
        <message>
            <source>flow bridge dropouts</source>
            <translation>光流中断补接</translation>
        </message>
        <message>
            <source>flow bridge after</source>
            <translation>光流补接起始时间</translation>
        </message>
        <message>
            <source>flow bridge sigma</source>
            <translation>光流补接 σ</translation>
        </message>
        <message>
            <source>flow bridge longest</source>
            <translation>光流补接最长时间</translation>
        </message>
        <message>
            <source>flow bridge memory</source>
            <translation>光流补接记忆时间</translation>
        </message>
        <message>
            <source>accelerometer use</source>
            <translation>使用加速度计</translation>
        </message>
        <message>
            <source>accelerometer sigma</source>
            <translation>加速度计 σ</translation>
        </message>
        <message>
            <source>yaw row use</source>
            <translation>使用航向方程</translation>
        </message>
        <message>
            <source>yaw row sigma</source>
            <translation>航向方程 σ</translation>
        </message>
        <message>
            <source>yaw row slowest</source>
            <translation>航向方程最低速度</translation>
        </message>
        <message>
            <source>yaw row mount offset</source>
            <translation>航向安装偏角</translation>
        </message>
        <message>
            <source>attitude sigma tilt</source>
            <translation>姿态倾斜 σ</translation>
        </message>
        <message>
            <source>attitude sigma heading</source>
            <translation>姿态航向 σ</translation>
        </message>
        <message>
            <source>attitude heading lag</source>
            <translation>姿态航向滞后</translation>
        </message>
        <message>
            <source>attitude sigma tilt held</source>
            <translation>保持姿态时倾斜 σ</translation>
        </message>
        <message>
            <source>attitude sigma heading held</source>
            <translation>保持姿态时航向 σ</translation>
        </message>
        <message>
            <source>attitude longest hold</source>
            <translation>姿态最长保持</translation>
        </message>
        <message>
            <source>attitude sigma tilt unknown</source>
            <translation>姿态未知时倾斜 σ</translation>
        </message>
        <message>
            <source>ties sigma</source>
            <translation>约束 σ</translation>
        </message>
        <message>
            <source>ties range sigma</source>
            <translation>约束测距 σ</translation>
        </message>
        <message>
            <source>ties correlation</source>
            <translation>约束相关时间</translation>
        </message>
        <message>
            <source>ties range tolerance</source>
            <translation>约束测距容差</translation>
        </message>
        <message>
            <source>ties shortest range</source>
            <translation>约束最短测距</translation>
        </message>
        <message>
            <source>ties longest range</source>
            <translation>约束最长测距</translation>
        </message>
        <message>
            <source>ties assumed height</source>
            <translation>假定手持高度</translation>
        </message>
        <message>
            <source>ties assumed height sigma</source>
            <translation>假定手持高度 σ</translation>
        </message>
        <message>
            <source>robust use</source>
            <translation>使用抗差</translation>
        </message>
        <message>
            <source>robust huber sigma</source>
            <translation>抗差 Huber σ</translation>
        </message>
        <message>
            <source>robust gate sigma</source>
            <translation>抗差门限 σ</translation>
        </message>
        <message>
            <source>robust longest gap</source>
            <translation>抗差最长间隔</translation>
        </message>
        <message>
            <source>robust readmit after</source>
            <translation>抗差重新接纳时间</translation>
        </message>
        <message>
            <source>divergence largest sigma</source>
            <translation>发散判据 最大 σ</translation>
        </message>
        <message>
            <source>divergence largest gnss distance</source>
            <translation>发散判据 与 GNSS 最大距离</translation>
        </message>
        <message>
            <source>divergence patience</source>
            <translation>发散判据 容忍时间</translation>
        </message>
        <message>
            <source>divergence rejected share</source>
            <translation>发散判据 剔除比例</translation>
        </message>
        <message>
            <source>divergence fewest rejected</source>
            <translation>发散判据 最少剔除数</translation>
        </message>
        <message>
            <source>divergence rejected window</source>
            <translation>发散判据 剔除窗口</translation>
        </message>
        <message>
            <source>aukf filter</source>
            <translation>AUKF 滤波器</translation>
        </message>
        <message>
            <source>aukf noise position e</source>
            <translation>AUKF 噪声 东向位置</translation>
        </message>
        <message>
            <source>aukf noise position n</source>
            <translation>AUKF 噪声 北向位置</translation>
        </message>
        <message>
            <source>aukf noise position u</source>
            <translation>AUKF 噪声 高程</translation>
        </message>
        <message>
            <source>aukf noise velocity e</source>
            <translation>AUKF 噪声 东向速度</translation>
        </message>
        <message>
            <source>aukf noise velocity n</source>
            <translation>AUKF 噪声 北向速度</translation>
        </message>
        <message>
            <source>aukf noise velocity u</source>
            <translation>AUKF 噪声 垂向速度</translation>
        </message>
        <message>
            <source>aukf noise acceleration e</source>
            <translation>AUKF 噪声 东向加速度</translation>
        </message>
        <message>
            <source>aukf noise acceleration n</source>
            <translation>AUKF 噪声 北向加速度</translation>
        </message>
        <message>
            <source>aukf noise acceleration u</source>
            <translation>AUKF 噪声 垂向加速度</translation>
        </message>
        <message>
            <source>aukf nominal interval</source>
            <translation>AUKF 标称间隔</translation>
        </message>
        <message>
            <source>aukf unscented alpha</source>
            <translation>AUKF 无迹变换 α</translation>
        </message>
        <message>
            <source>aukf unscented beta</source>
            <translation>AUKF 无迹变换 β</translation>
        </message>
        <message>
            <source>aukf unscented kappa</source>
            <translation>AUKF 无迹变换 κ</translation>
        </message>
        <message>
            <source>aukf yaw row use</source>
            <translation>AUKF 使用航向方程</translation>
        </message>
        <message>
            <source>aukf yaw row sigma</source>
            <translation>AUKF 航向方程 σ</translation>
        </message>
        <message>
            <source>aukf yaw row slowest</source>
            <translation>AUKF 航向方程最低速度</translation>
        </message>
        <message>
            <source>aukf yaw row mount offset</source>
            <translation>AUKF 航向安装偏角</translation>
        </message>
        <message>
            <source>aukf adaptive forgetting</source>
            <translation>AUKF 自适应遗忘因子</translation>
        </message>
        <message>
            <source>aukf adaptive least factor</source>
            <translation>AUKF 自适应最小因子</translation>
        </message>
        <message>
            <source>aukf adaptive greatest factor</source>
            <translation>AUKF 自适应最大因子</translation>
        </message>
        <message>
            <source>sigma range near</source>
            <translation>近距测距 σ</translation>
        </message>
        <message>
            <source>sigma range far share</source>
            <translation>远距测距 σ 比例</translation>
        </message>
        <message>
            <source>range near</source>
            <translation>近距界限</translation>
        </message>
        <message>
            <source>least range</source>
            <translation>最短测距</translation>
        </message>
        <message>
            <source>greatest range</source>
            <translation>最长测距</translation>
        </message>
        <message>
            <source>least strength</source>
            <translation>最低回波强度</translation>
        </message>
        <message>
            <source>greatest strength</source>
            <translation>最高回波强度</translation>
        </message>
        <message>
            <source>greatest tilt</source>
            <translation>最大倾斜</translation>
        </message>
        <message>
            <source>greatest sigma</source>
            <translation>最大平面 σ</translation>
        </message>
        <message>
            <source>greatest sigma u</source>
            <translation>最大高程 σ</translation>
        </message>
        <message>
            <source>spike sigma</source>
            <translation>尖刺 σ</translation>
        </message>
        <message>
            <source>spike window</source>
            <translation>尖刺窗口</translation>
        </message>
        <message>
            <source>spike floor</source>
            <translation>尖刺下限</translation>
        </message>
        <message>
            <source>clean statistical use</source>
            <translation>剔除统计粗差</translation>
        </message>
        <message>
            <source>clean statistical neighbours</source>
            <translation>统计粗差 邻点数</translation>
        </message>
        <message>
            <source>clean statistical sigmas</source>
            <translation>统计粗差 σ 倍数</translation>
        </message>
        <message>
            <source>clean radius use</source>
            <translation>剔除孤立点</translation>
        </message>
        <message>
            <source>clean radius radius</source>
            <translation>孤立点 半径</translation>
        </message>
        <message>
            <source>clean radius least neighbours</source>
            <translation>孤立点 最少邻点</translation>
        </message>
        <message>
            <source>clean above ground use</source>
            <translation>剔除地面以上物</translation>
        </message>
        <message>
            <source>clean above ground cell</source>
            <translation>地面以上物 格网</translation>
        </message>
        <message>
            <source>clean above ground greatest window</source>
            <translation>地面以上物 最大窗口</translation>
        </message>
        <message>
            <source>clean above ground slope</source>
            <translation>地面以上物 坡度</translation>
        </message>
        <message>
            <source>clean above ground least height</source>
            <translation>地面以上物 最低高度</translation>
        </message>
        <message>
            <source>clean above ground greatest height</source>
            <translation>地面以上物 最高高度</translation>
        </message>
        <message>
            <source>clean above ground link</source>
            <translation>地面以上物 连接距离</translation>
        </message>
        <message>
            <source>clean above ground terrace length</source>
            <translation>地面以上物 梯田长度</translation>
        </message>
        <message>
            <source>thinning cell</source>
            <translation>抽稀格网</translation>
        </message>
        <message>
            <source>fixed point runs</source>
            <translation>使用定点测线</translation>
        </message>
        <message>
            <source>longest edge</source>
            <translation>最长三角形边</translation>
        </message>
        <message>
            <source>terrace edges</source>
            <translation>梯田边缘</translation>
        </message>
        <message>
            <source>cross validate</source>
            <translation>交叉验证</translation>
        </message>
        <message>
            <source>cell</source>
            <translation>格网大小</translation>
        </message>
        <message>
            <source>multiband</source>
            <translation>多波段文件</translation>
        </message>
        <message>
            <source>occupancy use</source>
            <translation>绘制地面以上空间</translation>
        </message>
        <message>
            <source>occupancy voxel</source>
            <translation>体素边长</translation>
        </message>
        <message>
            <source>occupancy greatest range</source>
            <translation>空间图最大测距</translation>
        </message>
        <message>
            <source>occupancy ground layer</source>
            <translation>地面层厚度</translation>
        </message>
        <message>
            <source>occupancy greatest height</source>
            <translation>空间图最大高度</translation>
        </message>
        <message>
            <source>nearest sample limit</source>
            <translation>最近点界限</translation>
        </message>
        <message>
            <source>seed</source>
            <translation>随机种子</translation>
        </message>
        <message>
            <source>lasting gnss correlation</source>
            <translation>持续误差 GNSS 相关时间</translation>
        </message>
        <message>
            <source>lasting gnss white share</source>
            <translation>持续误差 GNSS 白噪声比例</translation>
        </message>
        <message>
            <source>lasting gnss white share fixed</source>
            <translation>持续误差 GNSS 白噪声比例 固定解</translation>
        </message>
        <message>
            <source>lasting heading sigma</source>
            <translation>持续误差 航向 σ</translation>
        </message>
        <message>
            <source>lasting heading correlation</source>
            <translation>持续误差 航向相关时间</translation>
        </message>
        <message>
            <source>lasting hard iron sigma</source>
            <translation>持续误差 硬磁 σ</translation>
        </message>
        <message>
            <source>lasting hard iron run sigma</source>
            <translation>持续误差 单次硬磁 σ</translation>
        </message>
        <message>
            <source>lasting flow scale sigma</source>
            <translation>持续误差 光流比例 σ</translation>
        </message>
        <message>
            <source>lasting flow axes sigma</source>
            <translation>持续误差 光流轴向 σ</translation>
        </message>
        <message>
            <source>lasting gyro bias sigma</source>
            <translation>持续误差 陀螺零偏 σ</translation>
        </message>
        <message>
            <source>lasting gyro scale sigma</source>
            <translation>持续误差 陀螺比例 σ</translation>
        </message>
        <message>
            <source>lasting gyro walk</source>
            <translation>持续误差 陀螺随机游走</translation>
        </message>
        <message>
            <source>lasting acceleration bias sigma</source>
            <translation>持续误差 加速度零偏 σ</translation>
        </message>
        <message>
            <source>lasting acceleration bias correlation</source>
            <translation>持续误差 加速度零偏相关时间</translation>
        </message>
        <message>
            <source>lasting tilt correlation</source>
            <translation>持续误差 倾斜相关时间</translation>
        </message>
        <message>
            <source>drift climb sigma</source>
            <translation>漂移滤波 爬升 σ</translation>
        </message>
        <message>
            <source>drift climb correlation</source>
            <translation>漂移滤波 爬升相关时间</translation>
        </message>
        <message>
            <source>drift adapt</source>
            <translation>漂移滤波 自适应</translation>
        </message>
        <message>
            <source>drift adapt memory</source>
            <translation>漂移滤波 自适应记忆</translation>
        </message>
        <message>
            <source>drift least factor</source>
            <translation>漂移滤波 最小因子</translation>
        </message>
        <message>
            <source>drift greatest factor</source>
            <translation>漂移滤波 最大因子</translation>
        </message>
        <message>
            <source>joint preview</source>
            <translation>整体平差 快速预览</translation>
        </message>
        <message>
            <source>joint knot</source>
            <translation>整体平差 节点间隔</translation>
        </message>
        <message>
            <source>joint heading knot</source>
            <translation>整体平差 航向节点</translation>
        </message>
        <message>
            <source>joint gnss knot</source>
            <translation>整体平差 GNSS 节点</translation>
        </message>
        <message>
            <source>joint barometer knot</source>
            <translation>整体平差 气压计节点</translation>
        </message>
        <message>
            <source>joint rounds</source>
            <translation>整体平差 轮数</translation>
        </message>
        <message>
            <source>joint use crossovers</source>
            <translation>整体平差 使用交叉点</translation>
        </message>
        <message>
            <source>joint adapt noise</source>
            <translation>整体平差 噪声自适应</translation>
        </message>
        <message>
            <source>joint crossovers spacing</source>
            <translation>交叉点 间距</translation>
        </message>
        <message>
            <source>joint crossovers gate</source>
            <translation>交叉点 门限</translation>
        </message>
        <message>
            <source>joint crossovers radius</source>
            <translation>交叉点 半径</translation>
        </message>
        <message>
            <source>joint crossovers apart</source>
            <translation>交叉点 最短时间差</translation>
        </message>
        <message>
            <source>joint crossovers bandwidth</source>
            <translation>交叉点 带宽</translation>
        </message>
        <message>
            <source>joint crossovers ridge</source>
            <translation>交叉点 岭参数</translation>
        </message>
        <message>
            <source>joint crossovers fewest points</source>
            <translation>交叉点 最少点数</translation>
        </message>
        <message>
            <source>joint pair sigma</source>
            <translation>点对 σ</translation>
        </message>
        <message>
            <source>joint pair even slope</source>
            <translation>点对 均匀坡度</translation>
        </message>
        <message>
            <source>joint pair uneven</source>
            <translation>点对 不平整度</translation>
        </message>
        <message>
            <source>joint pair apart</source>
            <translation>点对 每米距离的误差</translation>
        </message>
        <message>
            <source>joint pair plan share</source>
            <translation>点对 平面比例</translation>
        </message>
        <message>
            <source>joint pair weight</source>
            <translation>点对 权</translation>
        </message>
        <message>
            <source>joint left out crossovers</source>
            <translation>留出的交叉点</translation>
        </message>
        <message>
            <source>joint walk</source>
            <translation>整体平差 行走</translation>
        </message>
        <message>
            <source>joint ground roughness</source>
            <translation>地面粗糙度</translation>
        </message>
        <message>
            <source>joint ground climb</source>
            <translation>地面爬升</translation>
        </message>
        <message>
            <source>joint acceleration noise</source>
            <translation>整体平差 加速度噪声</translation>
        </message>
        <message>
            <source>joint acceleration knot</source>
            <translation>整体平差 加速度节点</translation>
        </message>
        <message>
            <source>joint blind climb</source>
            <translation>无高程观测时爬升</translation>
        </message>
        <message>
            <source>stretches</source>
            <translation>剔除的路段</translation>
        </message>
        <message>
            <source>runs</source>
            <translation>剔除的测线</translation>
        </message>
        <message>
            <source>marks</source>
            <translation>剔除的标志点</translation>
        </message>
        <message>
            <source>lines</source>
            <translation>绘制的线</translation>
        </message>
        <message>
            <source>lasting gnss bias sigma</source>
            <translation>持续误差 GNSS 偏差 σ</translation>
        </message>
        <message>
            <source>lasting gnss bias run sigma</source>
            <translation>持续误差 单次 GNSS 偏差 σ</translation>
        </message>
        <message>
            <source>vertical class</source>
            <translation>高程精度等级</translation>
        </message>
        <message>
            <source>lasting flow scale wander sigma</source>
            <translation>持续误差 光流比例缓变 σ</translation>
        </message>
        <message>
            <source>lasting flow scale correlation</source>
            <translation>持续误差 光流比例相关时间</translation>
        </message>
    </context>
    <context>
        <name>SettingChoice</name>
        <message>
            <source>Sensors as they are</source>
            <translation>直接用传感器</translation>
        </message>
        <message>
            <source>Unscented Kalman (UKF)</source>
            <translation>无迹卡尔曼 (UKF)</translation>
        </message>
        <message>
            <source>Paper's method (AUKF)</source>
            <translation>论文方法 (AUKF)</translation>
        </message>
        <message>
            <source>Terrawalk, all runs</source>
            <translation>Terrawalk 整体平差</translation>
        </message>
        <message>
            <source>Never</source>
            <translation>从不</translation>
        </message>
        <message>
            <source>With an RTK fix</source>
            <translation>有 RTK 解时</translation>
        </message>
        <message>
            <source>Always</source>
            <translation>始终</translation>
        </message>
        <message>
            <source>Extended Kalman (EKF)</source>
            <translation>扩展卡尔曼 (EKF)</translation>
        </message>
        <message>
            <source>Cubature Kalman (CKF)</source>
            <translation>容积卡尔曼 (CKF)</translation>
        </message>
        <message>
            <source>Square-root UKF</source>
            <translation>平方根 UKF</translation>
        </message>
        <message>
            <source>Adaptive UKF</source>
            <translation>自适应 UKF</translation>
        </message>
        <message>
            <source>Automatic</source>
            <translation>自动</translation>
        </message>
        <message>
            <source>Off</source>
            <translation>关闭</translation>
        </message>
        <message>
            <source>Linear (TIN)</source>
            <translation>线性 (TIN)</translation>
        </message>
        <message>
            <source>Natural neighbour</source>
            <translation>自然邻域</translation>
        </message>
        <message>
            <source>Sibson C1</source>
            <translation>Sibson C1</translation>
        </message>
        <message>
            <source>Clough-Tocher</source>
            <translation>Clough-Tocher</translation>
        </message>
        <message>
            <source>Inverse distance</source>
            <translation>反距离加权</translation>
        </message>
        <message>
            <source>Nearest point</source>
            <translation>最近点</translation>
        </message>
        <message>
            <source>Kriging</source>
            <translation>克里金</translation>
        </message>
        <message>
            <source>B-spline</source>
            <translation>B 样条</translation>
        </message>
        <message>
            <source>Slime mould, improved</source>
            <translation>改进黏菌算法</translation>
        </message>
        <message>
            <source>Slime mould, as printed</source>
            <translation>黏菌算法（论文原式）</translation>
        </message>
        <message>
            <source>Slime mould</source>
            <translation>黏菌算法</translation>
        </message>
        <message>
            <source>Particle swarm</source>
            <translation>粒子群</translation>
        </message>
        <message>
            <source>Genetic algorithm</source>
            <translation>遗传算法</translation>
        </message>
        <message>
            <source>Simulated annealing</source>
            <translation>模拟退火</translation>
        </message>
        <message>
            <source>NSGA-II</source>
            <translation>NSGA-II</translation>
        </message>
        <message>
            <source>Bee colony</source>
            <translation>人工蜂群</translation>
        </message>
        <message>
            <source>Differential evolution</source>
            <translation>差分进化</translation>
        </message>
        <message>
            <source>CMA-ES</source>
            <translation>CMA-ES</translation>
        </message>
    </context>
    <context>
        <name>SettingGroup</name>
        <message>
            <source>Fusion</source>
            <translation>融合</translation>
        </message>
        <message>
            <source>Stands on marks</source>
            <translation>标志点静站</translation>
        </message>
        <message>
            <source>Sigma points</source>
            <translation>Sigma 点</translation>
        </message>
        <message>
            <source>Process noise</source>
            <translation>过程噪声</translation>
        </message>
        <message>
            <source>Process model</source>
            <translation>过程模型</translation>
        </message>
        <message>
            <source>Start of a run</source>
            <translation>测线起始</translation>
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
            <source>Accelerometer</source>
            <translation>加速度计</translation>
        </message>
        <message>
            <source>Course against heading</source>
            <translation>行走方向与航向</translation>
        </message>
        <message>
            <source>Attitude</source>
            <translation>姿态</translation>
        </message>
        <message>
            <source>Ties to marks</source>
            <translation>标志点约束</translation>
        </message>
        <message>
            <source>Outliers</source>
            <translation>粗差</translation>
        </message>
        <message>
            <source>Divergence</source>
            <translation>发散</translation>
        </message>
        <message>
            <source>Lasting errors</source>
            <translation>持续误差</translation>
        </message>
        <message>
            <source>Vertical drift</source>
            <translation>垂向漂移</translation>
        </message>
        <message>
            <source>Adjustment of all runs</source>
            <translation>整体平差</translation>
        </message>
        <message>
            <source>Crossovers</source>
            <translation>交叉点</translation>
        </message>
        <message>
            <source>AUKF</source>
            <translation>AUKF</translation>
        </message>
        <message>
            <source>AUKF: process noise</source>
            <translation>AUKF：过程噪声</translation>
        </message>
        <message>
            <source>AUKF: sigma points</source>
            <translation>AUKF：Sigma 点</translation>
        </message>
        <message>
            <source>AUKF: course</source>
            <translation>AUKF：行走方向与航向</translation>
        </message>
        <message>
            <source>AUKF: adaptive noise</source>
            <translation>AUKF：自适应噪声</translation>
        </message>
        <message>
            <source>Ground points</source>
            <translation>地面点</translation>
        </message>
        <message>
            <source>Statistical outliers</source>
            <translation>统计粗差</translation>
        </message>
        <message>
            <source>Lonely points</source>
            <translation>孤立点</translation>
        </message>
        <message>
            <source>Things above the ground</source>
            <translation>地面以上物</translation>
        </message>
        <message>
            <source>Interpolation and grid</source>
            <translation>内插与格网</translation>
        </message>
        <message>
            <source>Space above the ground</source>
            <translation>地面以上空间</translation>
        </message>
        <message>
            <source>Report</source>
            <translation>报告</translation>
        </message>
    </context>
    <context>
        <name>SettingMeaning</name>
        <message>
            <source>raw: sensors as they are; ukf: 9-state unscented Kalman filter with gate and smoother; aukf: the method of paper 000 as it is; terrawalk: filter with error states, then one adjustment of all runs with their crossovers</source>
            <translation>raw：直接使用传感器；ukf：带门限和平滑的 9 状态无迹卡尔曼滤波；aukf：论文 000 的原方法；terrawalk：带误差状态的滤波，再对所有测线连同交叉点做整体平差</translation>
        </message>
        <message>
            <source>Rauch-Tung-Striebel pass after the filter</source>
            <translation>滤波之后做 Rauch-Tung-Striebel 平滑</translation>
        </message>
        <message>
            <source>still seconds at a start mark</source>
            <translation>在起点标志上静止的秒数</translation>
        </message>
        <message>
            <source>still seconds at a target mark</source>
            <translation>在终点标志上静止的秒数</translation>
        </message>
        <message>
            <source>targets of fixed-point runs hold the estimator; false: they only show its error</source>
            <translation>定点测线的终点约束估计；false：只用来显示其误差</translation>
        </message>
        <message>
            <source>spread of the sigma points; used by the yaw row only</source>
            <translation>sigma 点的散布；只用于航向方程</translation>
        </message>
        <message>
            <source>weight of the centre point, 2 for a Gaussian</source>
            <translation>中心点的权，高斯分布取 2</translation>
        </message>
        <message>
            <source>secondary spread of the sigma points</source>
            <translation>sigma 点的二次散布</translation>
        </message>
        <message>
            <source>process noise of the position, east, m2/s</source>
            <translation>位置的过程噪声，东向，m2/s</translation>
        </message>
        <message>
            <source>process noise of the position, north, m2/s</source>
            <translation>位置的过程噪声，北向，m2/s</translation>
        </message>
        <message>
            <source>process noise of the position, up, m2/s</source>
            <translation>位置的过程噪声，天向，m2/s</translation>
        </message>
        <message>
            <source>process noise of the velocity, east, m2/s3</source>
            <translation>速度的过程噪声，东向，m2/s3</translation>
        </message>
        <message>
            <source>process noise of the velocity, north, m2/s3</source>
            <translation>速度的过程噪声，北向，m2/s3</translation>
        </message>
        <message>
            <source>process noise of the velocity, up, m2/s3</source>
            <translation>速度的过程噪声，天向，m2/s3</translation>
        </message>
        <message>
            <source>process noise of the acceleration, east, m2/s5</source>
            <translation>加速度的过程噪声，东向，m2/s5</translation>
        </message>
        <message>
            <source>process noise of the acceleration, north, m2/s5</source>
            <translation>加速度的过程噪声，北向，m2/s5</translation>
        </message>
        <message>
            <source>process noise of the acceleration, up, m2/s5</source>
            <translation>加速度的过程噪声，天向，m2/s5</translation>
        </message>
        <message>
            <source>in which an acceleration dies away; 0: never</source>
            <translation>加速度衰减的时间；0：不衰减</translation>
        </message>
        <message>
            <source>longer gaps are cut into steps of this length</source>
            <translation>更长的间隔切成这么长的步</translation>
        </message>
        <message>
            <source>of the velocity at the start</source>
            <translation>起始时刻速度的 σ</translation>
        </message>
        <message>
            <source>of the acceleration at the start</source>
            <translation>起始时刻加速度的 σ</translation>
        </message>
        <message>
            <source>by which a position ages while nothing measures it</source>
            <translation>没有观测时位置精度随此速度下降</translation>
        </message>
        <message>
            <source>around a known start mark, before the ties to it</source>
            <translation>已知起点标志周围，在受其约束之前</translation>
        </message>
        <message>
            <source>below this the array counts as standing still</source>
            <translation>低于此速度视为阵列静止</translation>
        </message>
        <message>
            <source>use GNSS positions</source>
            <translation>使用 GNSS 位置</translation>
        </message>
        <message>
            <source>use GNSS (Doppler) velocities</source>
            <translation>使用 GNSS（多普勒）速度</translation>
        </message>
        <message>
            <source>when the GNSS height is used; rtk: with an RTK fix, fixed or float, and with any fix while no barometer tells</source>
            <translation>何时使用 GNSS 高程；rtk：有 RTK 解（固定或浮点）时，以及气压计无读数时的任何解</translation>
        </message>
        <message>
            <source>position, single point, per horizontal axis</source>
            <translation>单点定位的位置，每个水平轴</translation>
        </message>
        <message>
            <source>position, DGNSS, per horizontal axis</source>
            <translation>差分定位的位置，每个水平轴</translation>
        </message>
        <message>
            <source>position, RTK float, per horizontal axis</source>
            <translation>RTK 浮点解的位置，每个水平轴</translation>
        </message>
        <message>
            <source>position, RTK fixed, per horizontal axis</source>
            <translation>RTK 固定解的位置，每个水平轴</translation>
        </message>
        <message>
            <source>position, single point, height</source>
            <translation>单点定位的高程</translation>
        </message>
        <message>
            <source>position, DGNSS, height</source>
            <translation>差分定位的高程</translation>
        </message>
        <message>
            <source>position, RTK float, height</source>
            <translation>RTK 浮点解的高程</translation>
        </message>
        <message>
            <source>position, RTK fixed, height</source>
            <translation>RTK 固定解的高程</translation>
        </message>
        <message>
            <source>the receiver's own accuracy counts no less than this share of the sigmas above</source>
            <translation>接收机自报的精度不小于上述 σ 的这一比例</translation>
        </message>
        <message>
            <source>time in which a position error without RTK fix changes</source>
            <translation>无 RTK 解时位置误差变化的时间</translation>
        </message>
        <message>
            <source>the same with an RTK fix</source>
            <translation>有 RTK 解时的同一时间</translation>
        </message>
        <message>
            <source>Doppler velocity, per horizontal axis</source>
            <translation>多普勒速度，每个水平轴</translation>
        </message>
        <message>
            <source>Doppler velocity, up</source>
            <translation>多普勒速度，天向</translation>
        </message>
        <message>
            <source>time in which a velocity error changes</source>
            <translation>速度误差变化的时间</translation>
        </message>
        <message>
            <source>use the barometer</source>
            <translation>使用气压计</translation>
        </message>
        <message>
            <source>height per height of the standard atmosphere, from a fit at known marks</source>
            <translation>每单位标准大气高度对应的高度，由已知标志点拟合</translation>
        </message>
        <message>
            <source>white noise</source>
            <translation>白噪声</translation>
        </message>
        <message>
            <source>error by gusts of wind</source>
            <translation>阵风引起的误差</translation>
        </message>
        <message>
            <source>length of a gust</source>
            <translation>一阵风的长度</translation>
        </message>
        <message>
            <source>after this silence GNSS heights of any fix stand in, unless never</source>
            <translation>中断超过此时间后用任何解的 GNSS 高程代替，除非设为从不</translation>
        </message>
        <message>
            <source>drift since the barometer was zeroed, m per root of a minute</source>
            <translation>气压计归零以来的漂移，每根号分钟的米数</translation>
        </message>
        <message>
            <source>use the optical flow</source>
            <translation>使用光流</translation>
        </message>
        <message>
            <source>variance at rest, m2/s2</source>
            <translation>静止时的方差，m2/s2</translation>
        </message>
        <message>
            <source>growth of the variance with the square of the speed</source>
            <translation>方差随速度平方的增长</translation>
        </message>
        <message>
            <source>lasting error of scale, as a share of the speed</source>
            <translation>持续的比例误差，占速度的份额</translation>
        </message>
        <message>
            <source>for how long errors of scale and heading keep their direction</source>
            <translation>比例误差和航向误差保持方向的时间</translation>
        </message>
        <message>
            <source>flow_quality below this is rejected</source>
            <translation>flow_quality 低于此值的读数被剔除</translation>
        </message>
        <message>
            <source>reject readings of nothing amid motion, and those far from their neighbours</source>
            <translation>剔除运动中的零读数，以及与相邻读数相差很大的读数</translation>
        </message>
        <message>
            <source>let the recent mean flow stand in for missing readings</source>
            <translation>用近期的平均光流代替缺失的读数</translation>
        </message>
        <message>
            <source>after this time without a reading</source>
            <translation>没有读数达到此时间之后</translation>
        </message>
        <message>
            <source>of the mean that stands in</source>
            <translation>代用平均值的 σ</translation>
        </message>
        <message>
            <source>the mean stands in no longer than this after the last flow reading</source>
            <translation>最后一个光流读数之后，平均值代用不超过此时间</translation>
        </message>
        <message>
            <source>over which the mean is taken</source>
            <translation>取平均值的时间范围</translation>
        </message>
        <message>
            <source>use the accelerometer</source>
            <translation>使用加速度计</translation>
        </message>
        <message>
            <source>of the specific force, steps of the walk included</source>
            <translation>比力的 σ，包括步伐的影响</translation>
        </message>
        <message>
            <source>use the course of the walk against the heading (paper, eq 4)</source>
            <translation>用行走方向与航向对比（论文式 4）</translation>
        </message>
        <message>
            <source>of heading less course</source>
            <translation>航向减行走方向的 σ</translation>
        </message>
        <message>
            <source>slower than this the course is not used</source>
            <translation>低于此速度时不用行走方向</translation>
        </message>
        <message>
            <source>yaw of the array less course, counter-clockwise</source>
            <translation>阵列偏航角减行走方向，逆时针为正</translation>
        </message>
        <message>
            <source>roll and pitch</source>
            <translation>横滚和俯仰</translation>
        </message>
        <message>
            <source>heading</source>
            <translation>航向</translation>
        </message>
        <message>
            <source>by which the compass may come behind in turns</source>
            <translation>转弯时罗盘可能滞后的时间</translation>
        </message>
        <message>
            <source>roll and pitch while the last known ones stand in</source>
            <translation>沿用最后已知值时的横滚和俯仰</translation>
        </message>
        <message>
            <source>heading while the last known one stands in</source>
            <translation>沿用最后已知值时的航向</translation>
        </message>
        <message>
            <source>for how long a held heading rotates the flow</source>
            <translation>沿用的航向可旋转光流的时间</translation>
        </message>
        <message>
            <source>roll and pitch where none was ever given</source>
            <translation>从未给出时的横滚和俯仰</translation>
        </message>
        <message>
            <source>how well the array stands over a mark, per horizontal axis</source>
            <translation>阵列对准标志点的精度，每个水平轴</translation>
        </message>
        <message>
            <source>height of the array above a mark</source>
            <translation>阵列在标志点之上的高度</translation>
        </message>
        <message>
            <source>of both</source>
            <translation>以上两者的相关时间</translation>
        </message>
        <message>
            <source>a range that far from the median of the stand is left out</source>
            <translation>与静站中位数相差超过此值的测距被舍去</translation>
        </message>
        <message>
            <source>shorter ranges on a mark are not believed</source>
            <translation>标志点上更短的测距不可信</translation>
        </message>
        <message>
            <source>longer ranges on a mark are not believed</source>
            <translation>标志点上更长的测距不可信</translation>
        </message>
        <message>
            <source>of the array above a mark where no range was measured</source>
            <translation>没有测距时假定的阵列高度</translation>
        </message>
        <message>
            <source>of that height</source>
            <translation>该高度的 σ</translation>
        </message>
        <message>
            <source>down-weight and reject outliers</source>
            <translation>对粗差降权并剔除</translation>
        </message>
        <message>
            <source>from here on the weight falls</source>
            <translation>从此处开始降权</translation>
        </message>
        <message>
            <source>beyond this a reading is rejected</source>
            <translation>超过此值的读数被剔除</translation>
        </message>
        <message>
            <source>a silence this long ends a spell of rejections</source>
            <translation>这么长的中断结束一段连续剔除</translation>
        </message>
        <message>
            <source>a sensor rejected for so long is believed again</source>
            <translation>传感器被剔除这么久之后重新采信</translation>
        </message>
        <message>
            <source>a larger sigma ends the run with an error</source>
            <translation>σ 更大时该测线以错误结束</translation>
        </message>
        <message>
            <source>a track farther from GNSS ends the run with an error</source>
            <translation>轨迹离 GNSS 更远时该测线以错误结束</translation>
        </message>
        <message>
            <source>after this time</source>
            <translation>持续此时间之后</translation>
        </message>
        <message>
            <source>a larger share of rejected GNSS positions ends the run with an error</source>
            <translation>被剔除的 GNSS 位置占比更大时该测线以错误结束</translation>
        </message>
        <message>
            <source>rejected GNSS positions before their share counts</source>
            <translation>剔除数达到此值后占比才有效</translation>
        </message>
        <message>
            <source>over which the share is taken</source>
            <translation>计算占比的时间范围</translation>
        </message>
        <message>
            <source>which filter method aukf runs on the model of paper 000</source>
            <translation>aukf 在论文 000 的模型上运行哪种滤波</translation>
        </message>
        <message>
            <source>variance that a step adds to the position, east, m2</source>
            <translation>每一步给位置增加的方差，东向，m2</translation>
        </message>
        <message>
            <source>variance that a step adds to the position, north, m2</source>
            <translation>每一步给位置增加的方差，北向，m2</translation>
        </message>
        <message>
            <source>variance that a step adds to the position, up, m2</source>
            <translation>每一步给位置增加的方差，天向，m2</translation>
        </message>
        <message>
            <source>variance that a step adds to the velocity, east, m2/s2</source>
            <translation>每一步给速度增加的方差，东向，m2/s2</translation>
        </message>
        <message>
            <source>variance that a step adds to the velocity, north, m2/s2</source>
            <translation>每一步给速度增加的方差，北向，m2/s2</translation>
        </message>
        <message>
            <source>variance that a step adds to the velocity, up, m2/s2</source>
            <translation>每一步给速度增加的方差，天向，m2/s2</translation>
        </message>
        <message>
            <source>variance that a step adds to the acceleration, east, m2/s4</source>
            <translation>每一步给加速度增加的方差，东向，m2/s4</translation>
        </message>
        <message>
            <source>variance that a step adds to the acceleration, north, m2/s4</source>
            <translation>每一步给加速度增加的方差，北向，m2/s4</translation>
        </message>
        <message>
            <source>variance that a step adds to the acceleration, up, m2/s4</source>
            <translation>每一步给加速度增加的方差，天向，m2/s4</translation>
        </message>
        <message>
            <source>step to which the noise belongs; a step of another length adds its share of it</source>
            <translation>噪声所对应的步长；其他长度的步按比例增加</translation>
        </message>
        <message>
            <source>spread of the sigma points</source>
            <translation>sigma 点的散布</translation>
        </message>
        <message>
            <source>heading as a measurement of the course</source>
            <translation>把航向作为行走方向的观测</translation>
        </message>
        <message>
            <source>of the heading as a course</source>
            <translation>航向作为行走方向的 σ</translation>
        </message>
        <message>
            <source>below this speed the row is left out</source>
            <translation>低于此速度时舍去该方程</translation>
        </message>
        <message>
            <source>yaw of the array less course of the walk, counter-clockwise</source>
            <translation>阵列偏航角减行走方向，逆时针为正</translation>
        </message>
        <message>
            <source>filter adaptive-ukf: b, the noise remembers 1 / (1 - b) readings</source>
            <translation>adaptive-ukf 滤波：b，噪声记住 1 / (1 - b) 个读数</translation>
        </message>
        <message>
            <source>filter adaptive-ukf: least noise variance over the sensor's own</source>
            <translation>adaptive-ukf 滤波：噪声方差与传感器自身方差之比的最小值</translation>
        </message>
        <message>
            <source>filter adaptive-ukf: greatest; a reading that asks for more is left out</source>
            <translation>adaptive-ukf 滤波：最大值；要求更大的读数被舍去</translation>
        </message>
        <message>
            <source>of the range finder at short range</source>
            <translation>测距仪在近距的 σ</translation>
        </message>
        <message>
            <source>of the range finder beyond, as a share of the range</source>
            <translation>测距仪在远距的 σ，占距离的份额</translation>
        </message>
        <message>
            <source>up to here a range counts as short</source>
            <translation>不超过此值的测距算近距</translation>
        </message>
        <message>
            <source>shorter ranges are a hand or a leaf</source>
            <translation>更短的测距是手或叶片</translation>
        </message>
        <message>
            <source>longer ranges are not believed</source>
            <translation>更长的测距不可信</translation>
        </message>
        <message>
            <source>weaker returns are not believed</source>
            <translation>更弱的回波不可信</translation>
        </message>
        <message>
            <source>stronger returns are not believed</source>
            <translation>更强的回波不可信</translation>
        </message>
        <message>
            <source>between the ray and the vertical</source>
            <translation>测线与铅垂线的夹角</translation>
        </message>
        <message>
            <source>points of a less sure position are left out</source>
            <translation>位置更不确定的点被舍去</translation>
        </message>
        <message>
            <source>points of a less sure height are left out</source>
            <translation>高程更不确定的点被舍去</translation>
        </message>
        <message>
            <source>robust sigmas off the neighbours that make a spike; 0: no check</source>
            <translation>偏离相邻点多少个稳健 σ 算尖刺；0：不检查</translation>
        </message>
        <message>
            <source>path on each side in which neighbours count</source>
            <translation>两侧各多长路程内的相邻点参与</translation>
        </message>
        <message>
            <source>time on each side in which neighbours count</source>
            <translation>两侧各多长时间内的相邻点参与</translation>
        </message>
        <message>
            <source>least robust sigma of the neighbours</source>
            <translation>相邻点稳健 σ 的下限</translation>
        </message>
        <message>
            <source>leave out points farther from their neighbours than others are</source>
            <translation>剔除离邻点比其他点更远的点</translation>
        </message>
        <message>
            <source>that the distance is taken to</source>
            <translation>计算距离所用的邻点数</translation>
        </message>
        <message>
            <source>above the mean distance that leave a point out</source>
            <translation>超过平均距离多少个 σ 的点被剔除</translation>
        </message>
        <message>
            <source>leave out points with next to nobody around them</source>
            <translation>剔除周围几乎没有其他点的点</translation>
        </message>
        <message>
            <source>in which neighbours are counted, in space; 0: from the spacing of the points</source>
            <translation>在空间中统计邻点的半径；0：由点间距得出</translation>
        </message>
        <message>
            <source>that keep a point</source>
            <translation>保留一个点所需的邻点数</translation>
        </message>
        <message>
            <source>leave out what stands on the ground and is narrow: plants, a hand before the range finder</source>
            <translation>剔除立在地面上的窄小物体：植株、测距仪前的手</translation>
        </message>
        <message>
            <source>windows are 3, 5, 9, ... of these wide</source>
            <translation>窗口宽度为其 3、5、9…… 倍</translation>
        </message>
        <message>
            <source>what is wider is ground</source>
            <translation>更宽的是地面</translation>
        </message>
        <message>
            <source>of the ground</source>
            <translation>地面的坡度</translation>
        </message>
        <message>
            <source>of what is left out</source>
            <translation>被剔除物的最低高度</translation>
        </message>
        <message>
            <source>whatever stands higher is left out, steep ground or not</source>
            <translation>更高的一律剔除，不论地面是否陡峭</translation>
        </message>
        <message>
            <source>points that near belong to one thing</source>
            <translation>距离这么近的点属于同一物体</translation>
        </message>
        <message>
            <source>what goes on for so long is a terrace and stays; 0: nothing does</source>
            <translation>延续这么长的是梯田，保留；0：都不保留</translation>
        </message>
        <message>
            <source>one point stands for each cell of this size; 0: all points</source>
            <translation>每个这么大的格子由一个点代表；0：使用所有点</translation>
        </message>
        <message>
            <source>use the ground points of fixed-point runs as well</source>
            <translation>也使用定点测线的地面点</translation>
        </message>
        <message>
            <source>triangles with a longer edge are left out; 0: from the points</source>
            <translation>边更长的三角形被舍去；0：由点的密度决定</translation>
        </message>
        <message>
            <source>how heights between points are interpolated; auto: the best by cross-validation</source>
            <translation>点之间高程的内插方法；auto：由交叉验证选最好的</translation>
        </message>
        <message>
            <source>whether risers of half a metre and more are found in the points, for methods linear and clough-tocher to follow</source>
            <translation>是否在点中寻找半米及以上的田坎，供 linear 和 clough-tocher 方法遵循</translation>
        </message>
        <message>
            <source>compare a method that is named with the plain one</source>
            <translation>把指定的方法与普通方法比较</translation>
        </message>
        <message>
            <source>cell size of the DEM; 0: from the density of the points</source>
            <translation>DEM 的格网大小；0：由点的密度决定</translation>
        </message>
        <message>
            <source>write dem_multiband.tif as well: heights and standard errors, bands in the order of BAG</source>
            <translation>另写 dem_multiband.tif：高程和标准差，波段按 BAG 的顺序</translation>
        </message>
        <message>
            <source>map the space above the ground that the laser crossed (OctoMap) as well</source>
            <translation>同时绘制激光穿过的地面以上空间（OctoMap）</translation>
        </message>
        <message>
            <source>side of a voxel</source>
            <translation>体素的边长</translation>
        </message>
        <message>
            <source>of a longer ray the first part counts as free, its hit for nothing</source>
            <translation>更长的测线只有前段算空闲，其击中点不计</translation>
        </message>
        <message>
            <source>what lies lower above the DEM counts as ground</source>
            <translation>DEM 之上低于此值的算地面</translation>
        </message>
        <message>
            <source>how far up to look</source>
            <translation>向上查看的高度</translation>
        </message>
        <message>
            <source>marks farther from any ground point are not compared with one</source>
            <translation>离任何地面点更远的标志点不参与比较</translation>
        </message>
        <message>
            <source>of the confidence intervals in the report</source>
            <translation>报告中置信区间的随机种子</translation>
        </message>
        <message>
            <source>time in which the lasting error of GNSS positions changes</source>
            <translation>GNSS 位置持续误差变化的时间</translation>
        </message>
        <message>
            <source>white noise of GNSS positions as a share of the sigma of the fix</source>
            <translation>GNSS 位置的白噪声，占该解 σ 的份额</translation>
        </message>
        <message>
            <source>the same for RTK fixed</source>
            <translation>RTK 固定解的同一份额</translation>
        </message>
        <message>
            <source>compass error that wanders</source>
            <translation>缓慢变化的罗盘误差</translation>
        </message>
        <message>
            <source>time in which it changes</source>
            <translation>其变化的时间</translation>
        </message>
        <message>
            <source>compass error A sin yaw + B cos yaw, shared by all runs</source>
            <translation>罗盘误差 A sin yaw + B cos yaw，各测线共有</translation>
        </message>
        <message>
            <source>by which a run differs from that</source>
            <translation>单条测线与之的差异</translation>
        </message>
        <message>
            <source>error of scale of the optical flow, constant in a run</source>
            <translation>光流的比例误差，一条测线内不变</translation>
        </message>
        <message>
            <source>half the difference of the scales of forward and left</source>
            <translation>前向与左向比例之差的一半</translation>
        </message>
        <message>
            <source>bias of the gyro, constant in a run</source>
            <translation>陀螺零偏，一条测线内不变</translation>
        </message>
        <message>
            <source>error of scale of the gyro, constant in a run</source>
            <translation>陀螺的比例误差，一条测线内不变</translation>
        </message>
        <message>
            <source>by which a turn summed up from the gyro errs</source>
            <translation>由陀螺累加的转角的误差</translation>
        </message>
        <message>
            <source>bias of each axis of the accelerometer</source>
            <translation>加速度计每个轴的零偏</translation>
        </message>
        <message>
            <source>time in which that of the vertical axis wanders</source>
            <translation>垂直轴零偏变化的时间</translation>
        </message>
        <message>
            <source>time in which the error of the tilt wanders, and with it that of the level axes</source>
            <translation>倾斜误差变化的时间，水平轴零偏随之变化</translation>
        </message>
        <message>
            <source>vertical velocity of the array</source>
            <translation>阵列的垂向速度</translation>
        </message>
        <message>
            <source>the noise of each sensor follows its innovations</source>
            <translation>各传感器的噪声随其新息调整</translation>
        </message>
        <message>
            <source>in which older innovations fade</source>
            <translation>旧新息淡出的时间</translation>
        </message>
        <message>
            <source>least factor on the variance of a sensor</source>
            <translation>传感器方差的最小因子</translation>
        </message>
        <message>
            <source>greatest factor on the variance of a sensor</source>
            <translation>传感器方差的最大因子</translation>
        </message>
        <message>
            <source>a quick look: crossovers bend the filter's tracks in a second stage, without the adjustment</source>
            <translation>快速查看：交叉点在第二步修正滤波轨迹，不做整体平差</translation>
        </message>
        <message>
            <source>between the knots of the track's correction</source>
            <translation>轨迹改正的节点间隔</translation>
        </message>
        <message>
            <source>between the knots of the compass error</source>
            <translation>罗盘误差的节点间隔</translation>
        </message>
        <message>
            <source>between the knots of the GNSS error</source>
            <translation>GNSS 误差的节点间隔</translation>
        </message>
        <message>
            <source>between the knots of the barometer's drift</source>
            <translation>气压计漂移的节点间隔</translation>
        </message>
        <message>
            <source>rounds of the adjustment with crossovers</source>
            <translation>带交叉点的平差轮数</translation>
        </message>
        <message>
            <source>hold passes over the same ground together</source>
            <translation>使经过同一地面的各次行走彼此一致</translation>
        </message>
        <message>
            <source>scale the noise of each sensor by what its residuals say</source>
            <translation>按残差调整各传感器的噪声</translation>
        </message>
        <message>
            <source>along a pass between the places where others are looked for</source>
            <translation>沿行走方向寻找交叉的间距</translation>
        </message>
        <message>
            <source>farthest apart of two passes in plan</source>
            <translation>两次经过在平面上的最大距离</translation>
        </message>
        <message>
            <source>of the ground that is fitted about a crossover</source>
            <translation>在交叉点周围拟合地面的半径</translation>
        </message>
        <message>
            <source>passes of one run are at least so far apart in time</source>
            <translation>同一测线的两次经过至少相隔的时间</translation>
        </message>
        <message>
            <source>of the weights that fall with the distance from a crossover</source>
            <translation>随离交叉点距离下降的权的带宽</translation>
        </message>
        <message>
            <source>holds the slope at a crossover back where the points do not tell it</source>
            <translation>点不足以确定坡度时对坡度的约束</translation>
        </message>
        <message>
            <source>of each pass at a crossover</source>
            <translation>每次经过在交叉点的最少点数</translation>
        </message>
        <message>
            <source>misfit of two passes over even ground</source>
            <translation>两次经过在平整地面上的不符值</translation>
        </message>
        <message>
            <source>slope at which ground is half uneven</source>
            <translation>地面算半不平整的坡度</translation>
        </message>
        <message>
            <source>added to the misfit over uneven ground</source>
            <translation>在不平整地面上加到不符值上</translation>
        </message>
        <message>
            <source>added to that, times the squared distance of the passes</source>
            <translation>再加上此值乘以两次经过距离的平方</translation>
        </message>
        <message>
            <source>of the slope that turns errors of the plan into height</source>
            <translation>把平面误差变为高程的坡度份额</translation>
        </message>
        <message>
            <source>neighbouring crossovers share points</source>
            <translation>相邻交叉点共用一些点</translation>
        </message>
        <message>
            <source>share of the ground, in cells of 10 m, whose crossovers only test the result</source>
            <translation>只用来检验结果的地面份额，以 10 m 的格子计</translation>
        </message>
        <message>
            <source>random walk of the horizontal velocity</source>
            <translation>水平速度的随机游走</translation>
        </message>
        <message>
            <source>of the ground below the walk about its level</source>
            <translation>行走下方地面绕其平均面的起伏</translation>
        </message>
        <message>
            <source>by which that level wanders</source>
            <translation>该平均面的漂移</translation>
        </message>
        <message>
            <source>white noise of the accelerometer, which tells how the height bends; 0: it does not</source>
            <translation>加速度计的白噪声，反映高程如何弯曲；0：不使用</translation>
        </message>
        <message>
            <source>between the knots of the accelerometer's bias</source>
            <translation>加速度计零偏的节点间隔</translation>
        </message>
        <message>
            <source>by which the array climbs where no range was measured</source>
            <translation>没有测距时阵列的爬升</translation>
        </message>
        <message>
            <source>readings that are left out</source>
            <translation>剔除的读数</translation>
        </message>
        <message>
            <source>runs that are left out</source>
            <translation>剔除的测线</translation>
        </message>
        <message>
            <source>marks that are left out: neither control nor check</source>
            <translation>剔除的标志点：既不作控制也不作检查</translation>
        </message>
        <message>
            <source>lines that the surface keeps to, beside those of the survey's file</source>
            <translation>曲面所遵循的线，另加测量文件中的线</translation>
        </message>
        <message>
            <source>bias of GNSS positions without RTK, shared by all runs</source>
            <translation>无 RTK 时 GNSS 位置的偏差，所有测线共有</translation>
        </message>
        <message>
            <source>RMSE_V that the surface is tested for by the ASPRS standards; 0: none</source>
            <translation>按 ASPRS 标准检验地表所用的 RMSE_V；0：不检验</translation>
        </message>
        <message>
            <source>by which it wanders beside, where residuals of the flow show that it does; 0: never</source>
            <translation>此外比例缓慢变化的幅度，仅当光流残差表明确有变化时才估计；0：从不</translation>
        </message>
        <message>
            <source>time in which it wanders</source>
            <translation>其变化的时间</translation>
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
            <source>Quick preview</source>
            <translation>快速预览</translation>
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
        <name>ViewState</name>
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
            <source>Change of height</source>
            <translation>高程变化</translation>
        </message>
        <message>
            <source>No ground</source>
            <translation>不显示地面</translation>
        </message>
        <message>
            <source>Tracks by run</source>
            <translation>轨迹按测线</translation>
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
            <source>Tracks by residual</source>
            <translation>按残差着色</translation>
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
        <message>
            <source>Errors by group (%1)</source>
            <translation>按组误差 (%1)</translation>
        </message>
        <message>
            <source>Height error (%1)</source>
            <translation>高程误差 (%1)</translation>
        </message>
        <message>
            <source>Predicted σ (%1)</source>
            <translation>预测 σ (%1)</translation>
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
        <message>
            <source>Also points that were not used, with their reasons</source>
            <translation>也包括未使用的点及其原因</translation>
        </message>
        <message>
            <source>For the formats of points; without it, only those that the surface was made of</source>
            <translation>用于点的格式；不选则只含构成曲面的点</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::FigureTable</name>
        <message>
            <source>better</source>
            <translation>更好</translation>
        </message>
        <message>
            <source>worse</source>
            <translation>更差</translation>
        </message>
        <message>
            <source>Before</source>
            <translation>之前</translation>
        </message>
        <message>
            <source>Now</source>
            <translation>现在</translation>
        </message>
        <message>
            <source>Change</source>
            <translation>变化</translation>
        </message>
        <message>
            <source>%1 better, %2 worse than the run of %3</source>
            <translation>%1 优于、%2 劣于 %3 的处理</translation>
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
        <message>
            <source>Tunings and experiments (*.json *.csv);;All files (*)</source>
            <translation>调参和实验 (*.json *.csv);;所有文件 (*)</translation>
        </message>
        <message>
            <source>Rasters (*.tif *.asc);;All files (*)</source>
            <translation>栅格 (*.tif *.asc);;所有文件 (*)</translation>
        </message>
        <message>
            <source>Tuning or experiment</source>
            <translation>调参或实验</translation>
        </message>
        <message>
            <source>&amp;New from files…</source>
            <translation>从文件新建(&amp;N)…</translation>
        </message>
        <message>
            <source>Save settings &amp;as…</source>
            <translation>设置另存为(&amp;A)…</translation>
        </message>
        <message>
            <source>Co&amp;mpare with</source>
            <translation>比较对象(&amp;M)</translation>
        </message>
        <message>
            <source>Shows how the heights changed, as a layer of map and 3-D view</source>
            <translation>以地图和三维视图的图层显示高程变化</translation>
        </message>
        <message>
            <source>The run of %1</source>
            <translation>%1 的处理</translation>
        </message>
        <message>
            <source>No other run yet</source>
            <translation>还没有其他处理结果</translation>
        </message>
        <message>
            <source>Another DEM…</source>
            <translation>其他 DEM…</translation>
        </message>
        <message>
            <source>Earlier heights of the same ground</source>
            <translation>同一地面的早期高程</translation>
        </message>
        <message>
            <source>Nothing</source>
            <translation>不比较</translation>
        </message>
        <message>
            <source>Save settings as</source>
            <translation>设置另存为</translation>
        </message>
        <message>
            <source>Where to begin: a survey that is there, a new one from loose files, or a sample.</source>
            <translation>从这里开始：打开已有测量、用零散文件新建，或打开示例。</translation>
        </message>
        <message>
            <source>The map. Drag moves it, the wheel zooms about the cursor, a click tells what is there. The tools above measure, select and draw; Escape leaves them.</source>
            <translation>地图。拖动平移，滚轮以光标为中心缩放，单击查询该处。上方工具可量测、选择和绘制；Esc 退出工具。</translation>
        </message>
        <message>
            <source>The surface in three dimensions. Drag turns it, a right drag moves it, the wheel comes nearer; a click tells what is known of a place.</source>
            <translation>三维曲面。拖动旋转，右键拖动平移，滚轮拉近；单击查询该处。</translation>
        </message>
        <message>
            <source>Plots of the sensors, the fused runs, errors at marks and searches for parameters. Drag along the time axis selects a stretch in all views.</source>
            <translation>传感器、融合测线、标志点误差和参数搜索的图表。沿时间轴拖动可在所有视图中选中一段。</translation>
        </message>
        <message>
            <source>How far the results lie from the marks: figures, groups of errors, what they say and what they cannot say.</source>
            <translation>成果与标志点相差多少：数值、分组误差，它们说明了什么，又不能说明什么。</translation>
        </message>
        <message>
            <source>The report as it will be printed; save it as PDF or print it here.</source>
            <translation>报告的打印样式；可在此存为 PDF 或打印。</translation>
        </message>
        <message>
            <source>What is known of the place that was clicked: its height, where the error comes from, the nearest hits, and what another pass would give.</source>
            <translation>所单击处的信息：高程、误差来源、最近的测点，以及再走一遍会有什么改进。</translation>
        </message>
        <message>
            <source>The way from logs to a DEM, from above to below. Each step shows its important settings; the others unfold.</source>
            <translation>从记录到 DEM 的步骤，自上而下。每步显示重要设置，其余可展开。</translation>
        </message>
        <message>
            <source>Heights along the line that was drawn on the map, with their 95 % band and marks beside it.</source>
            <translation>沿地图上所画线的高程，含 95 % 区间和旁边的标志点。</translation>
        </message>
        <message>
            <source>What the program did and what went wrong, with the cure. Newest below.</source>
            <translation>程序做了什么、出了什么问题及如何解决。最新的在最下面。</translation>
        </message>
        <message>
            <source>All se&amp;ttings…</source>
            <translation>所有设置(&amp;T)…</translation>
        </message>
        <message>
            <source>Earlier &amp;runs…</source>
            <translation>历次处理(&amp;R)…</translation>
        </message>
        <message>
            <source>Runs, marks, edits and results. The box shows or hides a thing in all views; a click on a result shows it; the right button leaves a run or a mark out, or takes an edit back.</source>
            <translation>测线、标志点、编辑和成果。方框控制在所有视图中显示或隐藏；单击成果即显示；右键可剔除测线或标志点，或撤回编辑。</translation>
        </message>
        <message>
            <source>Opens a survey.json, or the folder that holds one</source>
            <translation>打开 survey.json 或其所在的文件夹</translation>
        </message>
        <message>
            <source>Makes a survey from array logs and a table of marks</source>
            <translation>由阵列日志和标志点表新建测量</translation>
        </message>
        <message>
            <source>Samples and the surveys of the last days</source>
            <translation>示例和最近的测量</translation>
        </message>
        <message>
            <source>Writes the settings and edits beside the survey, for this program and the command line</source>
            <translation>把设置和编辑写在测量旁边，供本程序和命令行使用</translation>
        </message>
        <message>
            <source>Writes the settings and edits into any file, for other surveys</source>
            <translation>把设置和编辑写入任意文件，供其他测量使用</translation>
        </message>
        <message>
            <source>Takes the settings of a file over; undo brings yours back</source>
            <translation>采用文件中的设置；可撤销</translation>
        </message>
        <message>
            <source>Fuses, cleans, makes the surface and checks it</source>
            <translation>融合、清理、生成曲面并检核</translation>
        </message>
        <message>
            <source>Stops what is running; what was there before stays</source>
            <translation>停止当前任务；原有结果保留</translation>
        </message>
        <message>
            <source>Figures and settings of the last runs, and the way back to one</source>
            <translation>最近处理的指标和设置，并可返回</translation>
        </message>
        <message>
            <source>Searches noise parameters that make errors at control marks small</source>
            <translation>搜索使控制点误差变小的噪声参数</translation>
        </message>
        <message>
            <source>Writes DEM, mesh, tracks and report into a folder</source>
            <translation>把 DEM、网格、轨迹和报告写入文件夹</translation>
        </message>
        <message>
            <source>Puts the command line that makes the same files on the clipboard</source>
            <translation>把生成相同文件的命令行复制到剪贴板</translation>
        </message>
        <message>
            <source>Closes the window; changes that are not saved come back next time</source>
            <translation>关闭窗口；未保存的更改下次会恢复</translation>
        </message>
        <message>
            <source>Takes the last change of settings or edits back</source>
            <translation>撤回上一次设置或编辑的更改</translation>
        </message>
        <message>
            <source>Makes the change again that was taken back</source>
            <translation>重做被撤回的更改</translation>
        </message>
        <message>
            <source>Leaves the selected stretch, run or mark out; the logs stay as they are</source>
            <translation>剔除所选路段、测线或标志点；日志不变</translation>
        </message>
        <message>
            <source>Every setting with its meaning, in groups and with a search</source>
            <translation>所有设置及其含义，分组并可搜索</translation>
        </message>
        <message>
            <source>Light colours on dark, or dark ones on light</source>
            <translation>深色或浅色界面</translation>
        </message>
        <message>
            <source>The window in Chinese or in English</source>
            <translation>窗口用中文或英文</translation>
        </message>
        <message>
            <source>All keys in one table</source>
            <translation>所有快捷键一览</translation>
        </message>
        <message>
            <source>Click a part of the window then, and it explains itself</source>
            <translation>随后单击窗口的任一部分即显示说明</translation>
        </message>
        <message>
            <source>Version and licence</source>
            <translation>版本和许可</translation>
        </message>
        <message>
            <source>Shows the view %1</source>
            <translation>显示%1视图</translation>
        </message>
        <message>
            <source>Shows or hides the panel %1</source>
            <translation>显示或隐藏%1面板</translation>
        </message>
        <message>
            <source>Leaves these readings of the selected stretch out, and keeps the others</source>
            <translation>剔除所选路段的这类读数，保留其他读数</translation>
        </message>
        <message>
            <source>Shows how the heights differ from those of a file</source>
            <translation>显示与文件中高程的差异</translation>
        </message>
        <message>
            <source>Shows how the heights changed since that run</source>
            <translation>显示自该次处理以来的高程变化</translation>
        </message>
        <message>
            <source>Takes the layer of changes away</source>
            <translation>移除变化图层</translation>
        </message>
        <message>
            <source>&amp;Units and numbers</source>
            <translation>单位与数字(&amp;U)</translation>
        </message>
        <message>
            <source>How lengths and numbers are written in the window; files and reports stay in metres</source>
            <translation>窗口中长度与数字的写法；文件和报告始终使用米</translation>
        </message>
        <message>
            <source>Metres</source>
            <translation>米</translation>
        </message>
        <message>
            <source>Feet (0.3048 m)</source>
            <translation>英尺（0.3048 m）</translation>
        </message>
        <message>
            <source>US survey feet</source>
            <translation>美国测量英尺</translation>
        </message>
        <message numerus="yes">
            <source>exclude %n stretches</source>
            <translation>
                <numerusform>排除 %n 段</numerusform>
            </translation>
        </message>
        <message>
            <source>%1 stretches, %2 s in all, are left out: process again to see what it changes.</source>
            <translation>已排除 %1 段，共 %2 s：重新处理即可看到变化。</translation>
        </message>
        <message>
            <source>One at a time: of what was dropped, %1 is taken.</source>
            <translation>一次只能打开一项：在拖入的内容中采用 %1。</translation>
        </message>
        <message>
            <source>Open a survey first: these are settings for one.</source>
            <translation>请先打开测量：这是测量的设置。</translation>
        </message>
        <message>
            <source>Process a survey first: its heights are compared with those of this DEM.</source>
            <translation>请先处理测量：其高程将与此 DEM 比较。</translation>
        </message>
        <message>
            <source>%1: this cannot be opened; drop a survey.json or its folder, logs and marks (.csv), settings (.json) or a DEM (.tif)</source>
            <translation>%1：无法打开；请拖入 survey.json 或其文件夹、日志和标志点（.csv）、设置（.json）或 DEM（.tif）</translation>
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
            <source>Colour of the tracks</source>
            <translation>轨迹颜色</translation>
        </message>
        <message>
            <source>What the tracks are coloured by</source>
            <translation>轨迹按什么着色</translation>
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
        <message>
            <source>Show</source>
            <translation>显示</translation>
        </message>
        <message>
            <source>What is drawn on the ground, here and in the 3-D view</source>
            <translation>地面上绘制的内容，此处和三维视图相同</translation>
        </message>
        <message>
            <source>What the ground is coloured by, here and in the 3-D view: shaded heights; their standard error; how many points a square metre has; whether a height was measured, interpolated or extrapolated; and, once View &gt; Compare with has something to compare, how the heights changed.</source>
            <translation>地面的着色方式，此处和三维视图相同：晕渲高程；其标准差；每平方米点数；高程是实测、内插还是外推；以及在“视图 &gt; 比较对象”选定后的高程变化。</translation>
        </message>
        <message>
            <source>What the tracks are coloured by: one colour for each run, the GNSS fix, speed, height, standard errors of the fused track, or by how many of them the worst reading was off.</source>
            <translation>轨迹的着色依据：每条测线一种颜色、GNSS 解类型、速度、高程、融合轨迹的标准差，或最差读数偏离了多少倍标准差。</translation>
        </message>
        <message>
            <source>Select an area</source>
            <translation>选择区域</translation>
        </message>
        <message>
            <source>Drag a rectangle: all passes through it are selected, with Shift beside earlier ones.</source>
            <translation>拖出矩形：选中穿过它的所有轨迹段；按住 Shift 可追加到已选的段。</translation>
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
            <source>   height %1</source>
            <translation>   高程 %1</translation>
        </message>
        <message>
            <source>, area %1</source>
            <translation>，面积 %1</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::NewSurveyDialog</name>
        <message>
            <source>New survey from files</source>
            <translation>从文件新建测量</translation>
        </message>
        <message>
            <source>Tables (*.csv);;All files (*)</source>
            <translation>表格 (*.csv);;所有文件 (*)</translation>
        </message>
        <message>
            <source>Add the logs of the array and the table of marks. What they are is guessed: look it over, and correct it.</source>
            <translation>添加阵列记录和标志点表。程序会推测它们的内容：请检查并更正。</translation>
        </message>
        <message>
            <source>Add files…</source>
            <translation>添加文件…</translation>
        </message>
        <message>
            <source>Logs and marks</source>
            <translation>记录和标志点</translation>
        </message>
        <message>
            <source>Add a folder…</source>
            <translation>添加文件夹…</translation>
        </message>
        <message>
            <source>Folder with logs and marks</source>
            <translation>含记录和标志点的文件夹</translation>
        </message>
        <message>
            <source>Take out</source>
            <translation>移除</translation>
        </message>
        <message>
            <source>Create and open</source>
            <translation>创建并打开</translation>
        </message>
        <message>
            <source>Runs</source>
            <translation>测线</translation>
        </message>
        <message>
            <source>Run</source>
            <translation>测线</translation>
        </message>
        <message>
            <source>Log</source>
            <translation>记录</translation>
        </message>
        <message>
            <source>Kind</source>
            <translation>类型</translation>
        </message>
        <message>
            <source>Starts on</source>
            <translation>起点</translation>
        </message>
        <message>
            <source>Ends on</source>
            <translation>终点</translation>
        </message>
        <message>
            <source>min:s</source>
            <translation>分:秒</translation>
        </message>
        <message>
            <source>Why</source>
            <translation>依据</translation>
        </message>
        <message>
            <source>Name</source>
            <translation>名称</translation>
        </message>
        <message>
            <source>Latitude of the zero point</source>
            <translation>零点纬度</translation>
        </message>
        <message>
            <source>Longitude of the zero point</source>
            <translation>零点经度</translation>
        </message>
        <message>
            <source>Ellipsoidal height of the zero point</source>
            <translation>零点椭球高</translation>
        </message>
        <message>
            <source>° N</source>
            <translation>°北纬</translation>
        </message>
        <message>
            <source>° E</source>
            <translation>°东经</translation>
        </message>
        <message>
            <source>m above the ellipsoid</source>
            <translation>m（椭球高）</translation>
        </message>
        <message>
            <source>Zero point</source>
            <translation>零点</translation>
        </message>
        <message>
            <source>Map frame</source>
            <translation>地图坐标系</translation>
        </message>
        <message>
            <source>An EPSG code such as EPSG:32649; empty: metres east and north of the zero point</source>
            <translation>EPSG 代码，例如 EPSG:32649；留空：自零点向东、向北的米数</translation>
        </message>
        <message>
            <source>Survey file</source>
            <translation>测量文件</translation>
        </message>
        <message>
            <source>There is a survey already: replace it</source>
            <translation>已有测量文件：替换</translation>
        </message>
        <message>
            <source>Kind of %1</source>
            <translation>%1 的类型</translation>
        </message>
        <message>
            <source>area walk</source>
            <translation>面积测线</translation>
        </message>
        <message>
            <source>fixed-point run</source>
            <translation>定点测线</translation>
        </message>
        <message>
            <source>–</source>
            <translation>–</translation>
        </message>
        <message>
            <source>Start of %1</source>
            <translation>%1 的起点</translation>
        </message>
        <message>
            <source>End of %1</source>
            <translation>%1 的终点</translation>
        </message>
        <message>
            <source>no table of marks</source>
            <translation>没有标志点表</translation>
        </message>
        <message numerus="yes">
            <source>%n mark(s) in %1</source>
            <translation>
                <numerusform>%1 中有 %n 个标志点</numerusform>
            </translation>
        </message>
        <message>
            <source>Give the survey a name.</source>
            <translation>请给测量起个名称。</translation>
        </message>
        <message>
            <source>The latitude is a number from −90 to 90, with a dot.</source>
            <translation>纬度是 −90 到 90 的数，小数点用“.”。</translation>
        </message>
        <message>
            <source>The longitude is a number from −180 to 180, with a dot.</source>
            <translation>经度是 −180 到 180 的数，小数点用“.”。</translation>
        </message>
        <message>
            <source>The height is a number of metres from −1000 to 10000, with a dot.</source>
            <translation>高程是 −1000 到 10000 的米数，小数点用“.”。</translation>
        </message>
        <message>
            <source>The files are being read…</source>
            <translation>正在读取文件…</translation>
        </message>
        <message>
            <source>Add at least one log of the array, or drop files onto this window.</source>
            <translation>请至少添加一个阵列记录，或把文件拖到此窗口。</translation>
        </message>
        <message numerus="yes">
            <source>%n file(s) cannot be used: mend them and add them again, or take them out.</source>
            <translation>
                <numerusform>%n 个文件无法使用：请修正后重新添加，或移除。</numerusform>
            </translation>
        </message>
        <message>
            <source>Name a file for the survey, such as survey.json.</source>
            <translation>请指定测量文件，例如 survey.json。</translation>
        </message>
        <message>
            <source>%1 does not exist: make it first, or choose another place.</source>
            <translation>%1 不存在：请先创建，或选择其他位置。</translation>
        </message>
        <message>
            <source>%1 is there already: choose another name, or let it be replaced.</source>
            <translation>%1 已存在：请换个名称，或允许替换。</translation>
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
            <translation>测线，时间</translation>
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
        <message>
            <source>away (%1)</source>
            <translation>距离 (%1)</translation>
        </message>
        <message>
            <source> · slope %1° · %2 to the nearest point · %3 points/m² · %4</source>
            <translation> · 坡度 %1° · 距最近点 %2 · %3 点/m² · %4</translation>
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
            <translation>测线</translation>
        </message>
        <message>
            <source>The run that is plotted</source>
            <translation>绘制的测线</translation>
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
            <translation>测线 %1</translation>
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
        <message>
            <source>Open a tuning or an experiment…</source>
            <translation>打开调参或实验…</translation>
        </message>
        <message>
            <source>A file that terrawalk tune wrote, or the CSV of terrawalk experiment fig10 and its like</source>
            <translation>terrawalk tune 写出的文件，或 terrawalk experiment fig10 等的 CSV</translation>
        </message>
        <message>
            <source>Leave this mark out</source>
            <translation>排除此点</translation>
        </message>
        <message>
            <source>Leaves %1 out of the next run</source>
            <translation>下次处理不再使用 %1</translation>
        </message>
        <message>
            <source>Click a mark first</source>
            <translation>请先单击一个标志点</translation>
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
            <translation>测线，时间</translation>
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
        <name>terrawalk::gui::RunsDialog</name>
        <message>
            <source>Earlier runs</source>
            <translation>历次处理</translation>
        </message>
        <message>
            <source>Compare heights</source>
            <translation>比较高程</translation>
        </message>
        <message>
            <source>Go back to this run</source>
            <translation>返回这次处理</translation>
        </message>
        <message>
            <source>Run</source>
            <translation>处理</translation>
        </message>
        <message>
            <source>Set otherwise than in the run before</source>
            <translation>与前一次不同的设置</translation>
        </message>
        <message>
            <source>Settings that differ from those of now</source>
            <translation>与当前不同的设置</translation>
        </message>
        <message>
            <source>Setting</source>
            <translation>设置</translation>
        </message>
        <message>
            <source>In that run</source>
            <translation>那次处理</translation>
        </message>
        <message>
            <source>Now</source>
            <translation>当前</translation>
        </message>
        <message>
            <source>%1, shown</source>
            <translation>%1（显示中）</translation>
        </message>
        <message>
            <source>%1, by %2</source>
            <translation>%1，%2</translation>
        </message>
        <message>
            <source>%1: %2</source>
            <translation>%1：%2</translation>
        </message>
        <message>
            <source>nothing</source>
            <translation>无</translation>
        </message>
        <message>
            <source>; </source>
            <translation>；</translation>
        </message>
        <message>
            <source>Its settings are those of now.</source>
            <translation>其设置与当前相同。</translation>
        </message>
        <message>
            <source>Shows its results and takes its settings over; undo brings yours back</source>
            <translation>显示其结果并采用其设置；可撤销</translation>
        </message>
        <message>
            <source>Takes its settings over, undo brings yours back; process again to see its results</source>
            <translation>采用其设置，可撤销；重新处理即可看到结果</translation>
        </message>
        <message>
            <source>Process it again</source>
            <translation>重新处理</translation>
        </message>
        <message>
            <source>Keep surfaces on disk, to compare heights after a restart</source>
            <translation>在磁盘上保留曲面，以便重启后比较高程</translation>
        </message>
        <message>
            <source>%1 on disk</source>
            <translation>磁盘上 %1</translation>
        </message>
        <message>
            <source>at most %1 for each run</source>
            <translation>每次处理至多 %1</translation>
        </message>
        <message>
            <source>Its results are shown.</source>
            <translation>正在显示其结果。</translation>
        </message>
        <message>
            <source>Its results are still here.</source>
            <translation>其结果仍在内存中。</translation>
        </message>
        <message>
            <source>Its surface is kept on disk (%1), so that heights can be compared. For the other views it has to be processed again.</source>
            <translation>其曲面保留在磁盘上（%1），因此可以比较高程。其他视图需要重新处理。</translation>
        </message>
        <message>
            <source>Only its settings and figures were kept. Processing it again gives its results back: the same logs, settings and version of the program give the same bytes.</source>
            <translation>只保留了其设置和数值。重新处理即可得到其结果：相同的日志、设置和程序版本给出逐字节相同的结果。</translation>
        </message>
        <message>
            <source>Process the survey first: its heights are compared with those of this run</source>
            <translation>请先处理测量：其高程将与该次处理比较</translation>
        </message>
        <message>
            <source>These are the heights that are shown</source>
            <translation>这就是正在显示的高程</translation>
        </message>
        <message>
            <source>The surface of this run was not kept</source>
            <translation>没有保留该次处理的曲面</translation>
        </message>
        <message>
            <source>How the heights changed since, as a layer</source>
            <translation>此后高程的变化，作为图层显示</translation>
        </message>
        <message>
            <source>Takes its settings over, undo brings yours back, and processes</source>
            <translation>采用其设置（撤销可恢复），并处理</translation>
        </message>
        <message>
            <source>Of the runs whose results are here and of those to come, until they leave this list. Unticked, no more are kept; those on disk stay until they are removed.</source>
            <translation>保留结果仍在内存中的和以后的处理的曲面，直到它们离开此列表。取消勾选则不再保留新的曲面，磁盘上已有的仍在，直到将其删除。</translation>
        </message>
        <message>
            <source>Remove from disk…</source>
            <translation>从磁盘删除…</translation>
        </message>
        <message>
            <source>Removes the kept surfaces; settings and figures of the runs stay</source>
            <translation>删除保留的曲面；各次处理的设置和数值仍在</translation>
        </message>
        <message>
            <source>Remove the kept surfaces (%1) from disk? This cannot be undone; a run that is processed again gives its surface back.</source>
            <translation>从磁盘删除保留的曲面（%1）？此操作无法撤销；重新处理即可再次得到曲面。</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::SettingEditor</name>
        <message>
            <source>auto</source>
            <translation>自动</translation>
        </message>
        <message>
            <source>&lt;p&gt;%1&lt;/p&gt;&lt;p&gt;Permitted: %2&lt;br&gt;Default: %3&lt;br&gt;&lt;tt&gt;%4&lt;/tt&gt;&lt;/p&gt;</source>
            <translation>&lt;p&gt;%1&lt;/p&gt;&lt;p&gt;允许值：%2&lt;br&gt;默认：%3&lt;br&gt;&lt;tt&gt;%4&lt;/tt&gt;&lt;/p&gt;</translation>
        </message>
        <message>
            <source>Back to the default of %1</source>
            <translation>恢复“%1”的默认值</translation>
        </message>
        <message>
            <source>Back to the default: %1</source>
            <translation>恢复默认：%1</translation>
        </message>
        <message>
            <source>on</source>
            <translation>开</translation>
        </message>
        <message>
            <source>off</source>
            <translation>关</translation>
        </message>
        <message>
            <source>%1 to %2</source>
            <translation>%1 至 %2</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::SettingsDialog</name>
        <message>
            <source>All settings</source>
            <translation>所有设置</translation>
        </message>
        <message>
            <source>Search by name, key or meaning, in English or Chinese</source>
            <translation>按名称、键或含义搜索，中英文均可</translation>
        </message>
        <message>
            <source>Search</source>
            <translation>搜索</translation>
        </message>
        <message>
            <source>Groups of settings</source>
            <translation>设置分组</translation>
        </message>
        <message>
            <source>Reset all</source>
            <translation>全部恢复默认</translation>
        </message>
        <message>
            <source>All settings back to their defaults; edits of the survey stay, and undo brings them back</source>
            <translation>所有设置恢复默认；测量的编辑保留，可撤销</translation>
        </message>
        <message>
            <source>Close</source>
            <translation>关闭</translation>
        </message>
        <message>
            <source>No setting is like that.</source>
            <translation>没有这样的设置。</translation>
        </message>
        <message>
            <source>%1 · %2</source>
            <translation>%1 · %2</translation>
        </message>
        <message>
            <source>Only changed (%1)</source>
            <translation>只看已改 (%1)</translation>
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
        <message>
            <source>Turn the view</source>
            <translation>转动视图</translation>
        </message>
        <message>
            <source>Shift+Arrows</source>
            <translation>Shift+方向键</translation>
        </message>
        <message>
            <source>Move the view</source>
            <translation>移动视图</translation>
        </message>
        <message>
            <source>Nearer and farther</source>
            <translation>拉近和拉远</translation>
        </message>
        <message>
            <source>The first view again</source>
            <translation>回到初始视图</translation>
        </message>
        <message>
            <source>Ask for no place any more</source>
            <translation>不再询问位置</translation>
        </message>
        <message>
            <source>Earlier and later</source>
            <translation>向前和向后</translation>
        </message>
        <message>
            <source>Zoom the time axis</source>
            <translation>缩放时间轴</translation>
        </message>
        <message>
            <source>In three dimensions</source>
            <translation>三维视图</translation>
        </message>
        <message>
            <source>On the plots</source>
            <translation>图表</translation>
        </message>
        <message>
            <source>Move the end of a stretch</source>
            <translation>移动所选段的终点</translation>
        </message>
        <message>
            <source>Move its start</source>
            <translation>移动其起点</translation>
        </message>
        <message>
            <source>Space</source>
            <translation>空格</translation>
        </message>
        <message>
            <source>Show a cross, then click there</source>
            <translation>显示十字，再按则在该处单击</translation>
        </message>
        <message>
            <source>Move the cross, by a pixel with Shift</source>
            <translation>移动十字，按住 Shift 则每次一像素</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::ShowMenu</name>
        <message>
            <source>Show</source>
            <translation>显示</translation>
        </message>
        <message>
            <source>Tracks</source>
            <translation>轨迹</translation>
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
            <source>Terrace edges</source>
            <translation>梯田边缘</translation>
        </message>
        <message>
            <source>Ground</source>
            <translation>地面</translation>
        </message>
        <message>
            <source>Colour of the tracks</source>
            <translation>轨迹颜色</translation>
        </message>
        <message>
            <source>Colours the ground by this, on the map and in 3-D</source>
            <translation>地面按此着色，地图和三维相同</translation>
        </message>
        <message>
            <source>Colours the tracks by this, on the map and in 3-D</source>
            <translation>轨迹按此着色，地图和三维相同</translation>
        </message>
        <message>
            <source>Draws this on the ground or not, on the map and in 3-D</source>
            <translation>在地图和三维中绘制或不绘制</translation>
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
        <message>
            <source>New survey from files…</source>
            <translation>从文件新建测量…</translation>
        </message>
        <message>
            <source>From array logs and a table of marks. Or drop them onto this window.</source>
            <translation>用阵列记录和标志点表。也可以把它们拖到此窗口。</translation>
        </message>
        <message>
            <source>or drop a survey.json, its folder, or logs and marks onto this window</source>
            <translation>或把 survey.json、其文件夹，或记录和标志点拖到此窗口</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::StepCard</name>
        <message numerus="yes">
            <source>%n more setting(s)…</source>
            <translation>
                <numerusform>其余 %n 项设置…</numerusform>
            </translation>
        </message>
        <message>
            <source>%1 %2 changed</source>
            <translation>%1 已改 %2 项</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::StepsPanel</name>
        <message>
            <source>%1, %2</source>
            <translation>%1，%2</translation>
        </message>
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
        <message numerus="yes">
            <source>%n run(s)</source>
            <translation>
                <numerusform>%n 条测线</numerusform>
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
        <message>
            <source>Who searches</source>
            <translation>优化器</translation>
        </message>
        <message>
            <source>The optimiser that searches; Plots &gt; Optimisers compared shows them side by side</source>
            <translation>进行搜索的优化器；“图表 &gt; 优化器比较”并排显示</translation>
        </message>
        <message>
            <source>Searches</source>
            <translation>搜索次数</translation>
        </message>
        <message>
            <source>Searches with seeds one after the other; the best of them is taken</source>
            <translation>用连续的种子搜索；取其中最好的</translation>
        </message>
        <message>
            <source>× </source>
            <translation>× </translation>
        </message>
        <message>
            <source>The last runs of this survey: their figures, what was set, and the way back</source>
            <translation>本测量最近的处理：指标、设置，并可返回</translation>
        </message>
        <message>
            <source>Earlier runs (%1)…</source>
            <translation>历次处理 (%1)…</translation>
        </message>
        <message>
            <source>Effort of the search</source>
            <translation>搜索工作量</translation>
        </message>
        <message>
            <source>Population</source>
            <translation>种群</translation>
        </message>
        <message>
            <source>Candidates that the search keeps; auto: 100 for aukf, 8 for other methods</source>
            <translation>搜索保留的候选数；自动：aukf 为 100，其他方法为 8</translation>
        </message>
        <message>
            <source>Iterations</source>
            <translation>迭代</translation>
        </message>
        <message>
            <source>How often each of them is tried anew; auto: 1000 for aukf, 6 for other methods</source>
            <translation>每个候选重新尝试的次数；自动：aukf 为 1000，其他方法为 6</translation>
        </message>
        <message>
            <source>auto</source>
            <translation>自动</translation>
        </message>
        <message>
            <source>Restarts</source>
            <translation>重启</translation>
        </message>
        <message>
            <source>Independent searches within one, each of that effort; the best is taken</source>
            <translation>一次搜索内的独立重启次数，每次工作量相同；取最好的</translation>
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
        <message>
            <source>the run of %1</source>
            <translation>%1 的处理</translation>
        </message>
        <message>
            <source>%1 % of the cells beyond 1.96 σ.</source>
            <translation>%1 % 的格网变化超出 1.96 σ。</translation>
        </message>
        <message>
            <source>all settings back to their defaults</source>
            <translation>所有设置恢复默认</translation>
        </message>
        <message>
            <source>The settings of the run of %1 are back: process again to see its results.</source>
            <translation>已恢复 %1 处理的设置：重新处理即可看到其结果。</translation>
        </message>
        <message numerus="yes">
            <source>%n earlier run(s) cannot be read by this version and are left out.</source>
            <translation>
                <numerusform>%n 次早前的处理本版本无法读取，已略去。</numerusform>
            </translation>
        </message>
        <message>
            <source>Less %1: median %2, RMS %3.</source>
            <translation>减去 %1：中位数 %2，RMS %3。</translation>
        </message>
        <message>
            <source>%1: %2.</source>
            <translation>%1：%2。</translation>
        </message>
        <message>
            <source>%1: cannot be written; check that you may write there</source>
            <translation>%1：无法写入；请检查写权限</translation>
        </message>
        <message>
            <source>The kept surfaces are removed from disk.</source>
            <translation>保留的曲面已从磁盘删除。</translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::SurveyTreeModel</name>
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
            <translation>测线</translation>
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
            <translation>面积测线 %1</translation>
        </message>
        <message>
            <source>Fixed-point run %1</source>
            <translation>定点测线 %1</translation>
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
            <source>Mesh</source>
            <translation>网格</translation>
        </message>
        <message>
            <source>%1 triangles</source>
            <translation>%1 个三角形</translation>
        </message>
        <message>
            <source>A click shows it</source>
            <translation>单击即显示</translation>
        </message>
        <message>
            <source>Point density</source>
            <translation>点密度</translation>
        </message>
        <message>
            <source>%1 % measured</source>
            <translation>%1 % 实测</translation>
        </message>
        <message>
            <source>Accuracy</source>
            <translation>精度</translation>
        </message>
        <message>
            <source>Report</source>
            <translation>报告</translation>
        </message>
        <message>
            <source>The box shows or hides them</source>
            <translation>方框控制显示或隐藏</translation>
        </message>
        <message>
            <source>%1, %2</source>
            <translation>%1，%2</translation>
        </message>
        <message>
            <source>median %1</source>
            <translation>中位数 %1</translation>
        </message>
        <message>
            <source>Sources</source>
            <translation>来源</translation>
        </message>
        <message>
            <source>Terraces</source>
            <translation>梯田</translation>
        </message>
        <message>
            <source>%1 left out</source>
            <translation>%1 已排除</translation>
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
        <message>
            <source>What is drawn on the surface, here and on the map</source>
            <translation>曲面上绘制的内容，此处和地图相同</translation>
        </message>
    </context>
</TS>
